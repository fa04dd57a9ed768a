//! Verdict on the momentum that downlinks can hold, in words, for table and picture.

use super::{found::Attainable, spacecraft::MappedSpacecraft};

/// How a share of the time is reported.
pub(super) fn share(spacecraft: &MappedSpacecraft) -> String {
    let downlink = &spacecraft.downlink;
    if downlink.share() == 0.0 {
        return "no downlinks (guided.*)".to_owned();
    }
    let [length, every] =
        [downlink.length_h, downlink.every_h].map(|hours| terminal::short((hours * 100.0).round() / 100.0));
    if downlink.share() < 1.0 {
        format!("downlinks of {length} h every {every} h")
    } else {
        format!("downlink without pause, {length} h begun every {every} h (guided.*)")
    }
}

/// Whether downlinks can undo the mission's mean disturbance.
pub(super) fn in_the_mean(attainable: &Attainable) -> &'static str {
    let Some((mission, _)) = &attainable.mission else { return "" };
    let undone = mission.mean_torque_n_m().map(|part| -part);
    if attainable.mean_added_n_m.holds(undone) {
        "which downlinks can undo"
    } else {
        "more than downlinks can undo"
    }
}

/// Sentences on a mission; none without one.
pub(super) fn on_mission(spacecraft: &MappedSpacecraft, attainable: &Attainable) -> Vec<String> {
    let Some((mission, held)) = &attainable.mission else { return Vec::new() };
    let length = format!("{:.1}", mission.length_d());
    let until = |day: Option<f64>| match day {
        Some(day) => format!("until day {day:.1} of {length}"),
        None => format!("through all {length} days"),
    };
    let [x, y, z] = spacecraft.threshold_n_m_s.map(terminal::short);
    let simulated = mission.dumps.map_or(String::new(), |dumps| format!("; simulated with {dumps} dumps"));
    vec![
        format!("holdable without a dump {} (X, Z within +-{x}, +-{z} N.m.s)", until(held.managed_d)),
        format!("without targets in downlinks {}{simulated}", until(held.unmanaged_d)),
        match held.y_d {
            Some(day) => format!("Y, which downlinks do not manage, leaves +-{y} N.m.s on day {day:.1}"),
            None => format!("Y, which downlinks do not manage, stays within +-{y} N.m.s"),
        },
    ]
}
