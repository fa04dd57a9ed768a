"""Limits of a slew's rate and acceleration, and the least time that they allow: accelerate, coast, decelerate."""

import math


class SlewLimits:
    """Limits in rad/s and rad/s2, both above 0."""

    NAMES = ("control.slewRate", "control.slewAcceleration")

    def __init__(self, rate_rad_s, acceleration_rad_s2):
        self.rate_rad_s, self.acceleration_rad_s2 = rate_rad_s, acceleration_rad_s2

    def least_s(self, angle_rad):
        """The least time of a slew by an angle."""
        rate, acceleration = self.rate_rad_s, self.acceleration_rad_s2
        if angle_rad < rate * rate / acceleration:
            return 2.0 * math.sqrt(angle_rad / acceleration)
        return angle_rad / rate + rate / acceleration

    def angle_rad(self, time_s):
        """The angle of a slew that takes `time_s` at least."""
        rate, acceleration = self.rate_rad_s, self.acceleration_rad_s2
        ramp_s = rate / acceleration
        return acceleration * time_s * time_s / 4.0 if time_s < 2.0 * ramp_s else rate * (time_s - ramp_s)
