//! The table on the screen.

use nalgebra::Vector3;
use physics::constants::{ASTRONOMICAL_UNIT_M, DAY_S};

use super::{
    found::Found,
    options::SourceKind,
    spacecraft::{MappedSpacecraft, WeighedSun},
    verdict,
};
use crate::{
    text_table::headed,
    torque_map::{Angles, Mapped, Rule},
};

/// Rows of a table at most.
const MAX_ROWS: usize = 12;
const NAMES: [&str; 3] = ["X", "Y", "Z"];

/// All of it.
pub(super) fn text(spacecraft: &MappedSpacecraft, found: &Found, source: SourceKind) -> String {
    let mut parts = vec![head(spacecraft, found, source)];
    let zone = found.zone.iter().map(|zone| (zone, "the keep-in zone"));
    for (mapped, where_) in core::iter::once((&found.sphere, "all directions")).chain(zone) {
        parts.push(lines(mapped, where_));
        parts.push(balances(mapped, where_));
    }
    parts.push(worths(found, &spacecraft.sun));
    parts.push(attainable(spacecraft, found));
    parts.join("\n\n")
}

fn head(spacecraft: &MappedSpacecraft, found: &Found, source: SourceKind) -> String {
    let panels: Vec<String> = spacecraft
        .lit
        .panels
        .iter()
        .map(|turned| match turned.rule {
            Rule::SunOffset { offset_rad, tilt_sign } => format!(
                "{} held {} deg off the Sun ({})",
                turned.panel.name,
                terminal::short(offset_rad.to_degrees()),
                if tilt_sign < 0.0 { "negative tilt" } else { "positive tilt" }
            ),
            Rule::Angle(angle_rad) => {
                format!("{} at {} deg", turned.panel.name, terminal::short(angle_rad.to_degrees()))
            }
        })
        .collect();
    let what = match source {
        SourceKind::Solar => "sunlight",
        SourceKind::Total => "sunlight and the recoil of its heat",
    };
    let zone = spacecraft.zone_rad.map(|limits_rad| {
        let [azimuth, elevation] = limits_rad.map(|limit_rad| terminal::short(limit_rad.to_degrees()));
        format!("{azimuth} deg of azimuth, {elevation} deg of elevation either way")
    });
    let zone = zone.unwrap_or_else(|| "none, so the Sun may stand anywhere (keepIn.*, --zone)".to_owned());
    let mut text = format!(
        "{}: torque of {what} about the centre of mass at {} AU, body frame; it goes with the inverse square of the distance.\n\
         Sun keep-in zone: {zone}.",
        spacecraft.name,
        terminal::short(spacecraft.lit.distance_m / ASTRONOMICAL_UNIT_M)
    );
    if !panels.is_empty() {
        text += &format!("\nPanels: {}.", panels.join("; "));
    }
    if spacecraft.panels_left_out {
        text += "\nEvery panel is mapped: panel[k].enabled = false counts in MomentumPlant alone.";
    }
    let mut table = headed("torque [uN.m] | azimuth [deg] | elevation [deg] | X | Y | Z | size");
    let mut row = |what: &str, place: Angles, torque_n_m: Vector3<f64>| {
        let mut cells = vec![what.to_owned()];
        cells.extend(place.map(angle));
        cells.extend(torque_n_m.iter().map(|part| micro(*part)));
        cells.push(micro(torque_n_m.norm()));
        table.add_row(cells);
    };
    row("Sun on -Y", [0.0; 2], found.ahead_n_m);
    if !spacecraft.sun.is_ahead() {
        let what = if spacecraft.sun.is_at_start { "Sun at start" } else { "Sun by --sun" };
        row(what, spacecraft.sun.angles_deg, found.weighed.0);
    }
    let least = if found.zone.is_some() { "least in the zone" } else { "least of all" };
    row(least, found.least.0, found.least.1);
    let zone = found.zone.iter().map(|zone| ("greatest in the zone", zone));
    for (what, mapped) in zone.chain([("greatest of all", &found.sphere)]) {
        let nodes = mapped.grid.nodes().map(|(place, load)| (place, load.torque_n_m));
        if let Some((place, torque_n_m)) = nodes.max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())) {
            row(what, place, torque_n_m);
        }
    }
    format!("{text}\n{table}")
}

/// Lines of zero torque by axis.
fn lines(mapped: &Mapped, where_: &str) -> String {
    let mut table = headed(
        "zero torque about | azimuth from, to [deg] | elevation from, to [deg] | elevation at azimuth 0 | azimuth at elevation 0",
    );
    let all =
        mapped.lines.iter().zip(NAMES).flat_map(|(lines, name)| lines.iter().map(move |line| (name, line)));
    let mut all: Vec<_> = all.collect();
    // The longest lines first within an axis.
    all.sort_by_key(|(name, line)| (*name, std::cmp::Reverse(line.places_deg.len())));
    let count = all.len();
    for (name, line) in all.into_iter().take(MAX_ROWS) {
        let span = |of: usize| line.extent_deg(of).map(angle).join(", ");
        let crossings = |of: usize| match line.is_along(of) {
            true => "along it".to_owned(),
            false => line.crossings_deg(of).into_iter().map(angle).collect::<Vec<_>>().join(", "),
        };
        table.add_row([name.to_owned(), span(0), span(1), crossings(0), crossings(1)]);
    }
    let mut text = format!("Lines of zero torque, {where_}");
    for (axis, (name, lines)) in NAMES.into_iter().zip(&mapped.lines).enumerate() {
        // A component of nothing but rounding.
        if mapped.grid.greatest_n_m(axis) <= 1e-12 * mapped.grid.most().1 {
            text += &format!("; {name} is zero everywhere");
        } else if lines.is_empty() {
            text += &format!("; none about {name}");
        }
    }
    if count > 0 {
        text += &format!("\n{table}");
    }
    text + &more(count)
}

fn balances(mapped: &Mapped, where_: &str) -> String {
    let count = mapped.balances.len();
    if count == 0 {
        return format!("Balance, {where_}: X and Z vanish together nowhere");
    }
    let mut table =
        headed("X and Z vanish at azimuth [deg] | elevation [deg] | Y [uN.m] | a small turn about X, Z is");
    for balance in mapped.balances.iter().take(MAX_ROWS) {
        let [mut azimuth, elevation] = balance.place_deg.map(angle);
        if balance.place_deg[1].abs() > 90.0 - 1e-4 {
            "any".clone_into(&mut azimuth);
        }
        let turned = if balance.is_restoring { "turned back" } else { "not turned back" };
        table.add_row([azimuth, elevation, micro(balance.torque_n_m.y), turned.to_owned()]);
    }
    format!("Balance, {where_}\n{table}{}", more(count))
}

fn more(count: usize) -> String {
    match count.saturating_sub(MAX_ROWS) {
        0 => String::new(),
        more => format!("\n{more} more: see --lines and the picture"),
    }
}

fn worths(found: &Found, sun: &WeighedSun) -> String {
    let mut table = headed(
        "a degree of | X [uN.m] | Y [uN.m] | Z [uN.m] | X [N.m.s per day] | Y [N.m.s per day] | Z [N.m.s per day]",
    );
    for worth in &found.weighed.1 {
        let torque_n_m = worth.torque_n_m_per_deg;
        let mut cells = vec![worth.what.clone()];
        cells.extend(torque_n_m.iter().map(|part| micro(*part)));
        cells.extend(torque_n_m.iter().map(|part| fixed(part * DAY_S)));
        table.add_row(cells);
    }
    let place = match sun.angles_deg.map(angle) {
        _ if sun.is_ahead() => "on -Y".to_owned(),
        [azimuth, elevation] => format!("at azimuth {azimuth} deg, elevation {elevation} deg"),
    };
    let why = if sun.is_at_start { ", as the attitude has it at the start (--sun)" } else { "" };
    format!("What a degree of tilt is worth with the Sun {place}{why}, panels turning with it\n{table}")
}

fn attainable(spacecraft: &MappedSpacecraft, found: &Found) -> String {
    let attainable = &found.attainable;
    let mut table = headed("downlinks can add [uN.m] | least | greatest | greatest [N.m.s per day]");
    for (axis, name) in ["X", "Z"].into_iter().enumerate() {
        let [low, high] = attainable.added_n_m.extent(axis);
        table.add_row([format!("mean torque about {name}"), micro(low), micro(high), fixed(high * DAY_S)]);
    }
    let mut text = format!(
        "Against the Sun on -Y, {} with the Sun elsewhere{}\n{table}",
        verdict::share(spacecraft),
        if found.zone.is_some() { " in the zone" } else { "" }
    );
    if let Some((mission, _)) = &attainable.mission {
        let [x, z] = mission.mean_torque_n_m().map(micro);
        text += &format!(
            "\nMission, by {}: mean disturbance X {x}, Z {z} uN.m, {}",
            mission.from,
            verdict::in_the_mean(attainable)
        );
    }
    for line in verdict::on_mission(spacecraft, attainable) {
        text += &format!("\n{line}");
    }
    text
}

fn angle(angle_deg: f64) -> String {
    format!("{angle_deg:.3}")
}

fn micro(value: f64) -> String {
    format!("{:.4}", value * 1e6)
}

fn fixed(value: f64) -> String {
    format!("{value:.5}")
}
