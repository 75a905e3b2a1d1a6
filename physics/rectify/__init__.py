from physics.rectify.correction import Correction as Correction
from physics.rectify.correction import Rectified as Rectified
from physics.rectify.order import rectify as rectify
