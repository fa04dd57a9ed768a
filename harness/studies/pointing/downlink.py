"""Start of the transition of paper 001's Figures 7 and 8 from downlink to the camera."""

from pointing.flight import days

# Sun and Earth are 33 deg apart as seen from the spacecraft, as the paper's antenna azimuth of -33 deg asks for with the Sun at
# azimuth and elevation 0. The paper prints no epoch.
EPOCH_S = days(3.15)
# Assumed: ten hours past periapsis, the end of the paper's eight hours of downlink about apoapsis.
TRUE_ANOMALY_DEG = 215.0
# "The commanded slew begins at 500 seconds".
SLEW_S = 500
