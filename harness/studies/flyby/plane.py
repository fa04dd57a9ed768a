"""B-plane of a flyby: what misses cost, what altitude they have, and a figure of them."""

import numpy as np

from study import exact
from vectors import norm

# Deviations of the ellipses that are drawn.
SIGMAS = 3.0
CIRCLE = np.column_stack([np.cos(np.linspace(0.0, 2.0 * np.pi, 361)), np.sin(np.linspace(0.0, 2.0 * np.pi, 361))])
# A reach that is so many times as wide as the rest is left to the second panel.
WIDER = 6.0
IN_REACH = "in reach of sunlight"


class Target:
    """Aim of a flight, the point at which a leg meets its B-plane as its mission is, and the effects of misses there.

    The cost of a miss is the manoeuvre 30 d behind the encounter that leads back to where the nominal flight is at the next flyby.
    """

    def __init__(self, leg):
        it = leg.encounter
        self.aim, self.aim_m, self.excess_m_s, self.by_miss_1_s = it.meets, it.b_m, it.excess_m_s, it.by_miss_1_s
        fmu, self.lead_h = leg.run.fmu("MomentumPlant.fmu"), it.lead_s / 3600.0
        self.gm_m3_s2, self.radius_m = (fmu.default(f"planet.{name}") for name in ("gravitationalParameter", "radius"))

    def cost_m_s(self, miss_m):
        """The manoeuvre for misses along T and R."""
        return norm(np.asarray(miss_m) @ self.by_miss_1_s.T)

    def periapsis_m(self, b_m):
        """The periapsis radius of a hyperbola by its B."""
        a_m = self.gm_m3_s2 / self.excess_m_s**2
        return np.hypot(a_m, b_m) - a_m

    def b_of_periapsis_m(self, periapsis_m):
        return np.sqrt(periapsis_m * (periapsis_m + 2.0 * self.gm_m3_s2 / self.excess_m_s**2))

    def altitude_offset_m(self, miss_m):
        """By how much the altitudes of misses are above that of the aim, without tides."""
        return self.periapsis_m(norm(self.aim_m + miss_m)) - self.periapsis_m(norm(self.aim_m))

    def misses_m(self, size_m, altitude_offset_m):
        """Misses of a size whose altitude is off by so much: one either side of the radial through the aim."""
        aim_m = norm(self.aim_m)
        b_m = self.b_of_periapsis_m(self.periapsis_m(aim_m) + altitude_offset_m)
        # Corners of the triangle with these sides.
        along_m = (b_m**2 - aim_m**2 - size_m**2) / (2.0 * aim_m)
        radial = self.aim_m / aim_m
        aside_m = np.sqrt(size_m**2 - along_m**2) * np.array([-radial[1], radial[0]])
        return [along_m * radial + sign * aside_m for sign in (1.0, -1.0)]

    def contour_m(self, cost_m_s):
        """Misses around the aim that cost so much."""
        return CIRCLE * (cost_m_s / self.cost_m_s(CIRCLE))[:, None]


def ellipse(covariance_m2):
    """Semi-axes of an ellipse of one standard deviation, the larger first, and their directions as columns."""
    variances, axes = np.linalg.eigh(covariance_m2)
    return np.sqrt(np.maximum(variances[::-1], 0.0)), axes[:, ::-1]


def write(run, name, title, target, intercepts, costs_m_s, reachable_m=()):
    """Draws intercepts about the aim with the planet and what misses cost, and writes them. Intercepts: label, miss along T and R,
    and the covariance of what is known of it, or None; `reachable_m` has the misses that sunlight can still reach."""
    run.line(f"B is that of the hyperbola osculating {target.lead_h:g} h before closest approach.")
    curves = []
    for label, miss_m, covariance_m2 in intercepts:
        if covariance_m2 is not None:
            semi_axes_m, axes = ellipse(covariance_m2)
            curves.append((f"three deviations, {label}", miss_m + SIGMAS * (CIRCLE * semi_axes_m) @ axes.T, "--"))
    curves += [(f"{cost_m_s:g} m/s", target.contour_m(cost_m_s), "-") for cost_m_s in costs_m_s]
    places_m = np.concatenate([np.zeros((1, 2)), *([[miss_m] for _, miss_m, _ in intercepts]), *(it for _, it, _ in curves)])
    close_km = np.abs(places_m).max() / 1e3
    if len(reachable_m) > 0:
        reached_km = np.abs(reachable_m).max() / 1e3
        close_km = max(close_km, reached_km) if reached_km < WIDER * close_km else close_km
        curves.append((IN_REACH, np.append(reachable_m, reachable_m[:1], axis=0), "-"))

    def shown(miss_m):
        """In km; T to the right and R down, as seen along the asymptote."""
        return ((target.aim_m + miss_m) * [1.0, -1.0] / 1e3).T

    x_label = f"B.T {target.lead_h:g} h before closest approach [km]"
    drawing, (close, wide) = run.axes(title, x_label, ["-B.R [km]"] * 2, 5.2, is_row=True)
    circles = {"impact": target.b_of_periapsis_m(target.radius_m), "altitude of the aim": norm(target.aim_m)}
    for axes in (close, wide):
        axes.plot(*shown(np.zeros(2)), "o", fillstyle="none", markersize=8.0, label="aim")
        for label, miss_m, _ in intercepts:
            axes.plot(*shown(miss_m), "o", label=label)
        for label, radius_m in circles.items():
            axes.plot(*(CIRCLE.T * radius_m / 1e3), "-" if label == "impact" else "--", label=label)
        for label, points_m, style in curves:
            axes.plot(*shown(points_m), style, label=label)
        axes.set_aspect("equal")
    centre_km, wide_km = shown(np.zeros(2)), 1.3 * norm(target.aim_m) / 1e3 + close_km
    close.set(title="about the aim", xlim=centre_km[0] + 1.15 * close_km * np.array([-1.0, 1.0]))
    close.set_ylim(centre_km[1] + 1.15 * close_km * np.array([-1.0, 1.0]))
    wide.locator_params(nbins=5)
    wide.set(title="Mercury", xlim=(-wide_km, wide_km), ylim=(-wide_km, wide_km))
    drawing.legend(*close.get_legend_handles_labels(), loc="outside lower center", ncols=3, frameon=False)
    run.figure(f"{name}.svg", drawing)

    rows = [("aim", np.zeros(2)), *((label, miss_m) for label, miss_m, _ in intercepts)]
    rows += [(IN_REACH, miss_m) for miss_m in reachable_m]
    for cost_m_s in costs_m_s:
        rows += [(f"contour of {cost_m_s:g} m/s", miss_m) for miss_m in target.contour_m(cost_m_s)]
    header = "what | b_t_m | b_r_m | miss_t_m | miss_r_m | cost_m_s | altitude_offset_m | osculation_before_h"
    cells = (
        [
            label,
            *map(exact, (*(target.aim_m + miss_m), *miss_m, target.cost_m_s(miss_m), target.altitude_offset_m(miss_m))),
            exact(target.lead_h),
        ]
        for label, miss_m in rows
    )
    run.csv(f"{name}.csv", header, cells)
