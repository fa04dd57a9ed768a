"""Paper 001: safe modes reached in a loop of Guidance and the controlled plant.

Attitude lost: +Z at the Sun with the keep-in zone off; the star tracker fails at 300 s and the gyros keep the estimate
valid for 60 s; all Sun sensors fail at 2000 s and work again at 4400 s, the star tracker at 6000 s; Safe Hold is requested
at 6300 s, Operational at 7800 s, and the first pointing command is set all the time. Zone violated: the same pointing; the
zone is put in force at 300 s, Operational is requested at 2400 s. All times, the rates of Earth Acquisition and search, and
how long the monitor waits are assumed: the paper prints none.
"""

import sys

sys.path[0] += "/.."
import numpy as np

from control.guided_loop import STEP, LoopFlight, open_loop
from study import agrees, brief, exact, flag, main
from vectors import across, angle_rad, body_angles_deg, norm, to_body, unit

# 2009-04-06 00:00 TDB past J2000, the start of the default flight; before apoapsis, far from eclipse and hot pole, assumed.
EPOCH_S = 292_248_000.0
TRUE_ANOMALY_DEG = 160.0
# The boresight of Earth Acquisition and centre of the keep-in zone by default.
BORESIGHT = np.array([0.0, -1.0, 0.0])
# The star tracker fails; the gyros keep the estimate valid for so long without it, assumed, short.
TRACKER_FAILS_S = 300.0
OUTAGE_S = 60.0
LOST_S = TRACKER_FAILS_S + OUTAGE_S
# Every Sun sensor fails, and works again a third of a turn into the search's second round.
SUN_LOST_S = 2000.0
SUN_BACK_S = 4400.0
TRACKER_BACK_S = 6000.0
# Safe Hold is requested, and Operational.
SAFE_HOLD_S = 6300.0
OPERATIONAL_S = 7800.0
# The keep-in zone is put in force, and Operational is requested after that.
ZONE_ON_S = 300.0
PARDONED_S = 2400.0
# Exchange and sample: what is seen at one second acts at the next and shows at the one after.
DELAY_S = 3.0
# The end of a phase, in which what was commanded is to have come true.
SETTLED_S = 200.0
# Largest angle between a commanded and an actual direction then, and error of a rate as a share of it.
ANGLE_DEG = 0.1
RATE = 0.01

# +Z at the Sun, rolled toward the Earth.
PLUS_Z_AT_THE_SUN = {
    "guidance.pointing.scenario": "generic",
    "guidance.boresight.option": "vector",
    "guidance.aimpoint.option": "sun",
    "guidance.bodyRoll.option": "vector",
    "guidance.externalRoll.option": "earth",
    "guidance.boresight.vector": [0.0, 0.0, 1.0],
    "guidance.bodyRoll.vector": [1.0, 0.0, 0.0],
}


def tracker(has_failed):
    """The star trackers' failure."""
    return {f"plant.starTracker.{name}": has_failed for name in ("failed", "spareFailed")}


def sensors(has_failed):
    """The Sun sensors' failure."""
    return {f"plant.sunSensor[{k}].failed": has_failed for k in range(1, 7)}


# What is set when, and the end of the flight.
CHAINS = {
    "attitude lost": (
        {
            0.0: PLUS_Z_AT_THE_SUN,
            TRACKER_FAILS_S: tracker(True),
            SUN_LOST_S: sensors(True),
            SUN_BACK_S: sensors(False),
            TRACKER_BACK_S: tracker(False),
            SAFE_HOLD_S: {"guidance.mode.request": "safeHold"},
            OPERATIONAL_S: {"guidance.mode.request": "operational"},
        },
        9300.0,
    ),
    "zone violated": (
        {
            0.0: PLUS_Z_AT_THE_SUN,
            ZONE_ON_S: {"guidance.keepIn.enabled": True},
            PARDONED_S: {"guidance.mode.request": "operational"},
        },
        4000.0,
    ),
}


def simulated(loop, label, step_s):
    """The flight of a chain of modes; the Sun is where the keep-in zone would not let it be."""
    events, stop_s = CHAINS[label]
    settings = {"plant.starTracker.outage": OUTAGE_S, "guidance.keepIn.enabled": False}
    return LoopFlight(loop, label, settings, EPOCH_S, TRUE_ANOMALY_DEG, stop_s, step_s, lambda time_s, _: events.get(time_s, {}))


class Checks:
    """Statements of paper 001 on its safe modes, looked for in a flight: statements, whether they hold, and what the flight shows."""

    def __init__(self, loop, flight):
        self.flight, self.time_s, self.stop_s, self.rows = flight, flight.time_s, flight.time_s[-1], []
        self.mode, self.kind = flight["guidance.mode.active"], flight["guidance.command.kind"]
        self.modes = {it: loop.item("guidance.mode.active", it) for it in ("operational", "safeHold", "earthAcquisition")}
        self.kinds = {it: loop.item("guidance.command.kind", it) for it in ("attitude", "errorQuaternion", "rateOnly")}
        self.limits = {name: loop.default(f"guidance.{name}") for name in ("earthAcquisition.rate", "sunSearch.rate")}
        self.limits |= {name: loop.default(f"guidance.{name}") for name in ("sunSearch.duration", "link.beam")}
        self.limits |= {name: loop.default(f"guidance.monitor.{name}") for name in ("persistence", "margin")}
        self.zone_deg, self.safe_hold_deg = (
            np.degrees([loop.default(f"guidance.{zone}.{name}") for name in ("azimuth", "elevation")])
            for zone in ("keepIn", "safeHold.keepIn")
        )
        sun_body_m = flight.sun_body_m()
        self.sun_angle_deg = np.degrees(angle_rad(BORESIGHT, sun_body_m))
        self.plus_z_deg = np.degrees(angle_rad(np.array([0.0, 0.0, 1.0]), sun_body_m))
        self.sun_body_m = sun_body_m

    def add(self, statement, holds, found):
        self.rows.append((statement, holds, found))

    def phase(self, from_s, to_s):
        """The seconds from one time to another."""
        return (self.time_s >= from_s) & (self.time_s <= to_s)

    def after_s(self, since_s, is_so):
        """Time from an instant until a condition first holds."""
        found = self.time_s[is_so & (self.time_s >= since_s)]
        return found[0] - since_s if len(found) > 0 else np.nan

    def is_mode(self, mode):
        return self.mode == self.modes[mode]

    def is_kind(self, kind):
        return self.kind == self.kinds[kind]

    def turns_about(self, phase, axis, commanded_rad_s):
        """Whether the errors of the rate along an axis and across it are small beside what is commanded, and text."""
        rate_rad_s = self.flight.rate_rad_s[phase]
        along = np.abs(rate_rad_s @ axis - commanded_rad_s).max() / commanded_rad_s
        aside = norm(across(rate_rad_s, axis)).max() / commanded_rad_s
        text = f"{np.degrees(commanded_rad_s):.4f} deg/s to {brief(100.0 * along)} % along, {brief(100.0 * aside)} % across"
        return along <= RATE and aside <= RATE, text

    def acquired(self, statement, from_s, to_s):
        """The Sun on the boresight at the end of a phase, and since when."""
        off_deg = self.sun_angle_deg[self.phase(to_s - SETTLED_S, to_s)].max()
        start_deg = self.sun_angle_deg[self.time_s == from_s][0]
        taken_s = self.time_s[(self.time_s <= to_s) & (self.sun_angle_deg > ANGLE_DEG)][-1] - from_s
        text = f"{start_deg:.1f} deg off, {ANGLE_DEG} deg after {taken_s:.0f} s, then {brief(off_deg)} deg"
        self.add(statement, off_deg <= ANGLE_DEG, text)

    def operational(self, statement, phase):
        """Operational, with +Z at the Sun."""
        off_deg = self.plus_z_deg[phase].max()
        holds = self.is_mode("operational")[phase].all() and off_deg < ANGLE_DEG
        self.add(statement, holds, f"+Z within {brief(off_deg)} deg of the Sun")

    def outside_deg(self, directions, zone_deg):
        """Angles by which body directions are outside a zone; negative within."""
        return np.max(np.abs(body_angles_deg(directions)) - zone_deg, axis=-1)

    def attitude_lost(self):
        """Inertial reference, then the Sun, are lost and found."""
        flight, time_s, limits = self.flight, self.time_s, self.limits
        self.operational("Operational: every pointing option", self.phase(0.0, LOST_S - 1.0))
        is_known = flight["plant.estimate.valid"] == 1.0
        invalid_s = self.after_s(0.0, ~is_known)
        demoted_s = self.after_s(invalid_s, self.is_mode("earthAcquisition"))
        holds = abs(invalid_s - LOST_S) <= DELAY_S and demoted_s <= DELAY_S
        found = f"lost at {invalid_s:.0f} s, demoted {demoted_s:.0f} s later"
        self.add("inertial reference lost: Earth Acquisition", holds, found)
        holds = self.is_kind("errorQuaternion")[self.phase(LOST_S + DELAY_S, SUN_LOST_S)].all()
        self.add("quaternion error and rate instead of an attitude", holds, f"to {SUN_LOST_S:.0f} s")
        self.acquired("boresight to the Sun", LOST_S, SUN_LOST_S)
        settled = self.phase(SUN_LOST_S - SETTLED_S, SUN_LOST_S)
        turns = self.turns_about(settled, BORESIGHT, limits["earthAcquisition.rate"])
        self.add("slow rotation about the Sun direction", *turns)
        search_s = self.after_s(SUN_LOST_S, self.is_kind("rateOnly"))
        self.add("Sun lost: rate only", search_s <= DELAY_S, f"{search_s:.0f} s after the last Sun sensor failed")
        search_to_s = self.search(SUN_LOST_S + search_s)
        again = flight.command_rate_rad_s[self.phase(search_to_s, SUN_BACK_S)]
        holds = np.all(again == [limits["sunSearch.rate"], 0.0, 0.0])
        self.add("cycling is repeated", holds, f"about X again to {SUN_BACK_S:.0f} s")
        found_s = self.after_s(SUN_BACK_S, self.is_kind("errorQuaternion"))
        found = f"{found_s:.0f} s after the Sun sensors work again"
        self.add("until a valid reading of the Sun", found_s <= DELAY_S, found)
        self.acquired("boresight to the Sun again", SUN_BACK_S, TRACKER_BACK_S)
        known_s = self.after_s(TRACKER_BACK_S, is_known)
        is_kept = self.is_mode("earthAcquisition")[self.phase(TRACKER_BACK_S, SAFE_HOLD_S)].all()
        found = f"attitude known {known_s:.0f} s after the tracker works, mode kept to {SAFE_HOLD_S:.0f} s"
        self.add("promotion only by ground command", is_kept and known_s <= DELAY_S, found)
        end = self.phase(OPERATIONAL_S - SETTLED_S, OPERATIONAL_S)
        inside_deg = -self.outside_deg(self.sun_body_m[end], self.safe_hold_deg).max()
        is_held = self.is_mode("safeHold")[self.phase(SAFE_HOLD_S + DELAY_S, OPERATIONAL_S)].all()
        self.add("Safe Hold: strict Sun safety", is_held and inside_deg >= 0.0, f"{inside_deg:.2f} deg inside its zone")
        earth_body_m = to_body(flight.q[end], flight.to_earth_m[end])
        off_deg, has_link = np.abs(body_angles_deg(earth_body_m)[:, 1]).max(), np.all(
            flight["guidance.link.available"][end] == 1.0
        )
        found = f"Earth within {brief(off_deg)} deg of the antennas' plane, link {'kept' if has_link else 'lost'}"
        holds = has_link and off_deg <= np.degrees(limits["link.beam"])
        self.add("an attitude that maintains communication with Earth", holds, found)
        off_deg = self.plus_z_deg[end].min()
        self.add("all other commands are ignored", off_deg > 60.0, f"+Z {off_deg:.1f} deg from the commanded Sun")
        self.operational("Operational by ground command", time_s >= self.stop_s - SETTLED_S)

    def search(self, from_s):
        """The search for the Sun about one axis after the other; returns its end."""
        rate_rad_s, duration_s = self.limits["sunSearch.rate"], self.limits["sunSearch.duration"]
        end_s = from_s + 3.0 * duration_s
        for number, statement in enumerate(
            ("about a first body axis for a duration", "then about a second", "then about a third")
        ):
            begin_s = from_s + number * duration_s
            to_s = begin_s + duration_s
            is_commanded = self.flight.command_rate_rad_s[:, number] == rate_rad_s
            seconds = np.sum(is_commanded & self.phase(SUN_LOST_S, end_s - 1.0))
            is_whole = is_commanded[self.phase(begin_s, to_s - 1.0)].all()
            turns, text = self.turns_about(self.phase(to_s - SETTLED_S, to_s - 1.0), np.eye(3)[number], rate_rad_s)
            self.add(statement, is_whole and turns, f"{'XYZ'[number]} for {seconds} s, {text}")
        return end_s

    def zone_violated(self):
        """The keep-in zone is put in force while the Sun is outside."""
        flight, time_s = self.flight, self.time_s
        commanded = time_s >= ZONE_ON_S + DELAY_S
        sun_m = to_body(flight.command_q[commanded], flight.to_sun_m[commanded])
        most_deg = self.outside_deg(sun_m, self.zone_deg).max()
        holds = self.is_kind("attitude")[commanded].all() and most_deg < 1e-6
        self.add("the command is forced into the zone", holds, f"at most {brief(most_deg)} deg outside")
        beyond_deg = self.outside_deg(self.sun_body_m, self.zone_deg)
        demoted_s = self.after_s(ZONE_ON_S, self.is_mode("safeHold"))
        in_time = self.limits["persistence"] <= demoted_s <= self.limits["persistence"] + DELAY_S
        is_outside = beyond_deg[time_s <= ZONE_ON_S].min() > np.degrees(self.limits["margin"])
        holds = is_outside and in_time and not self.is_mode("earthAcquisition").any()
        sun_deg = self.sun_angle_deg[time_s == ZONE_ON_S][0]
        found = f"Sun {sun_deg:.1f} deg from -Y, Safe Hold {demoted_s:.0f} s later"
        self.add("a violation that persists demotes to the next lowest mode", holds, found)
        outside_deg = self.outside_deg(self.sun_body_m, self.safe_hold_deg)
        back_s = self.after_s(ZONE_ON_S, outside_deg <= 0.0)
        inside_deg = -outside_deg[self.phase(PARDONED_S - SETTLED_S, PARDONED_S)].max()
        stays = np.all(outside_deg[self.phase(ZONE_ON_S + back_s, PARDONED_S)] <= 0.0)
        found = f"inside after {back_s:.0f} s, then by {inside_deg:.2f} deg"
        self.add("a safing turn to a Sun-safe attitude", stays, found)
        holds = self.is_mode("safeHold")[self.phase(ZONE_ON_S + demoted_s, PARDONED_S)].all()
        self.add("promotion only by ground command", holds, f"Safe Hold to {PARDONED_S:.0f} s")
        end = time_s >= self.stop_s - SETTLED_S
        boundary_deg, off_deg = np.abs(beyond_deg[end]).max(), self.plus_z_deg[end].min()
        is_held = np.all(self.is_mode("operational")[end] & (flight["guidance.constraint.sunKeepIn"][end] == 1.0))
        found = f"Sun within {brief(boundary_deg)} deg of the boundary, {off_deg:.1f} deg from +Z"
        holds = is_held and boundary_deg < ANGLE_DEG
        self.add("Operational: the valid attitude closest to the target", holds, found)


def history(label, flight, checks):
    """The rows of the CSV file with everything of every second."""
    sun, earth = unit(flight.to_sun_m), unit(flight.to_earth_m)
    numbers = np.column_stack(
        [flight.time_s, flight.q, flight.rate_rad_s, sun, earth, checks.sun_angle_deg, flight.command_rate_rad_s]
    )
    flags = [flight[f"plant.{it}"] for it in ("estimate.valid", "sun.sensedValid", "control.saturated")]
    dumps, link = flight["plant.dump.count"], flight["guidance.link.available"]
    for k, row in enumerate(numbers):
        own = [flag(it[k]) for it in (*flags, link)]
        yield [label, *map(exact, row), int(checks.mode[k]), int(checks.kind[k]), *own[:3], int(dumps[k]), own[3]]


def draw(run, label, flight, checks):
    """Mode, Sun, rates and flags over time; the first second has no command yet."""
    labels = ["mode", "command", "Sun [deg]", "rate [deg/s]", "valid"]
    drawing, (mode, command, sun, rate, valid) = run.axes(f"Safe modes: {label}", "time [s]", labels, 1.8)
    time_s = flight.time_s[1:]
    mode.plot(time_s, checks.mode[1:], label="1 Operational, 2 Safe Hold, 3 Earth Acquisition")
    command.plot(time_s, checks.kind[1:], label="1 attitude, 2 error quaternion, 3 rate only")
    sun.plot(time_s, checks.sun_angle_deg[1:], label="from -Y")
    rate.plot(time_s, np.degrees(flight.rate_rad_s[1:]), label=["X", "Y", "Z"])
    if label == "attitude lost":
        acquisition_deg_s = -np.degrees(checks.limits["earthAcquisition.rate"])
        rate.plot([LOST_S, SUN_LOST_S], [acquisition_deg_s] * 2, "--", label="earthAcquisition.rate about -Y")
        search_deg_s = np.degrees(checks.limits["sunSearch.rate"])
        rate.plot([SUN_LOST_S, SUN_BACK_S], [search_deg_s] * 2, "--", label="sunSearch.rate")
    valid.plot(time_s, flight["plant.estimate.valid"][1:], label="estimated attitude")
    valid.plot(time_s, flight["plant.sun.sensedValid"][1:], "--", label="sensed Sun")
    valid.plot(time_s, flight["guidance.link.available"][1:], label="link with the Earth")
    for axes in (mode, command):
        axes.set(ylim=(0.5, 3.5), yticks=(1, 2, 3))
    valid.set(ylim=(-0.15, 1.15), yticks=(0, 1))
    run.figure(f"safe-mode-{label.replace(' ', '-')}.svg", drawing)


def safe_mode(run):
    labels = run.chosen(CHAINS)
    loop = open_loop(run)
    flights = run.all(labels, lambda label: simulated(loop, label, run.options.step))
    run.line("Safe modes (paper 001), Guidance and the controlled plant in a loop\n")
    checked = [Checks(loop, flight) for flight in flights]
    for label, checks in zip(labels, checked):
        checks.attitude_lost() if label == "attitude lost" else checks.zone_violated()
    rows = [
        [label, statement, found, agrees(holds)]
        for label, checks in zip(labels, checked)
        for statement, holds, found in checks.rows
    ]
    run.table_and_csv("safe-mode.csv", "case | paper 001 | found | verdict", rows)
    run.remark()
    header = (
        "case | time_s | q1 | q2 | q3 | q4 | rate_x_rad_s | rate_y_rad_s | rate_z_rad_s | sun_x | sun_y | sun_z | earth_x | "
        "earth_y | earth_z | sun_angle_deg | command_x_rad_s | command_y_rad_s | command_z_rad_s | mode | command_kind | "
        "attitude_known | sun_sensed | torque_limited | dumps | link"
    )
    cells = (row for it in zip(labels, flights, checked) for row in history(*it))
    run.csv("safe-mode-history.csv", header, cells)
    for it in zip(labels, flights, checked):
        draw(run, *it)


main(safe_mode, step=STEP)
