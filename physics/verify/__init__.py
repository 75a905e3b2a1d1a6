from physics.verify.verdict import Verdict as Verdict
from physics.verify.verdict import verify as verify
