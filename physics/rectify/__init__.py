from physics.rectify.correction import Correction as Correction
from physics.rectify.correction import Key as Key
from physics.rectify.correction import Rectified as Rectified
from physics.rectify.order import rectify as rectify
from physics.rectify.order import redo as redo
from physics.rectify.order import undo as undo
