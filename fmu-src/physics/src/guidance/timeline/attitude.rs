//! A command's attitude instead of a scenario, as a command of the scenario generic; and its name.

use super::description::{AttitudeDescription, AxesDescription, CommandDescription};
use crate::enumeration::Enumerated;
use crate::guidance::pointing::aligned::aligned_command;
use crate::guidance::pointing::command::PointingCommand;
use crate::spacecraft::{AttitudeName, NamedAttitude, Panel, aligned, axes};
use crate::toml::{Place, hint};

/// Attitudes that have a name.
const NAMES: [AttitudeName; 3] = [AttitudeName::Lvlh, AttitudeName::YawSteering, AttitudeName::SunPointing];

/// Reads the command of an attitude at `place`, without its scan, for a spacecraft with these panels.
pub(super) fn by_attitude(
    place: &Place<'_>,
    attitude: &AttitudeDescription,
    panels: &[Panel],
) -> PointingCommand {
    let axes = read(place, attitude).and_then(|it| axes(place, &it, panels, [place, place]));
    axes.map_or_else(PointingCommand::default, |axes| aligned_command(&axes))
}

/// The attitude of a description.
fn read(at: &Place<'_>, given: &AttitudeDescription) -> Option<NamedAttitude> {
    match given {
        AttitudeDescription::Name(name) => {
            let names = NAMES.map(Enumerated::name);
            let unknown = format!("the unknown word `{name}`{}", hint(name, &names));
            let allowed = format!("{}, or a quaternion, or `align` and `constrain`", names.join(", "));
            let found = NAMES.into_iter().find(|known| known.name() == name);
            at.known(found, unknown, allowed).map(NamedAttitude::Named)
        }
        AttitudeDescription::Quaternion(numbers) => {
            let allowed = "four: a quaternion from EME2000 to the body, scalar last";
            let q = <[f64; 4]>::try_from(numbers.as_slice()).ok();
            at.known(q, format_args!("{} numbers", numbers.len()), allowed).map(NamedAttitude::Inertial)
        }
        AttitudeDescription::Axes(AxesDescription { align, constrain, star, unknown }) => {
            for key in unknown {
                at.key(key).report(format_args!("the unknown key `{key}`"), "align, constrain, star");
            }
            if let (Some(align), Some(constrain)) = (align, constrain) {
                return aligned(at, [align, constrain], star.as_ref());
            }
            let lacking = if align.is_none() { "align" } else { "constrain" };
            at.report_lack(lacking, "both `align` and `constrain`");
            None
        }
        AttitudeDescription::Other => {
            at.report("no attitude", "a name, a quaternion, or a table with `align` and `constrain`");
            None
        }
    }
}

/// The name of a command: its own, or its scenario's or attitude's.
pub(super) fn name(at: &Place<'_>, given: &CommandDescription) -> String {
    /// Longest name in a report.
    const MOST: usize = 60;
    match (&given.name, given.scenario) {
        (Some(name), _) => {
            if name.trim().is_empty() || name.chars().count() > MOST || name.chars().any(char::is_control) {
                let allowed = format!("a text of 1 to {MOST} characters on one line");
                at.key("name").report(format_args!("{name:?}"), allowed);
            }
            name.clone()
        }
        (None, Some(scenario)) => scenario.name().to_owned(),
        (None, None) => match &given.attitude {
            Some(AttitudeDescription::Name(name)) => name.clone(),
            Some(AttitudeDescription::Quaternion(_)) => "inertial".to_owned(),
            Some(AttitudeDescription::Axes(_) | AttitudeDescription::Other) => "aligned".to_owned(),
            None => "guided".to_owned(),
        },
    }
}

#[cfg(test)]
mod tests {
    //! An attitude is the scenario generic with its axes; names are given ones, or tell what is commanded.

    use nalgebra::Vector3;

    use super::*;
    use crate::guidance::timeline::Timeline;
    use crate::spacecraft::{AlignedAxes, MESSENGER_TOML, Spacecraft, TargetItem, TargetedAxis};

    #[test]
    fn attitudes_are_commands_by_two_axes() {
        let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
        let command = |attitude: &str| {
            let text = format!("[[command]]\nat = 0\nattitude = {attitude}\n");
            Timeline::of_plant("t.toml", &text, &spacecraft).unwrap().entries[0].command
        };
        assert_eq!(command("\"lvlh\""), aligned_command(&AlignedAxes::LVLH));
        let toward = |axis_body, target| TargetedAxis { axis_body, target };
        let star = TargetItem::Star.target([10_f64, -20_f64].map(f64::to_radians));
        let axes = AlignedAxes {
            align: toward(Vector3::new(0.0, 0.0, 2.0), star),
            constrain: toward(-Vector3::y(), TargetItem::Sun.target([0.0; 2])),
        };
        let written = "{ align = { axis = [0, 0, 2], to = \"star\" }, constrain = { axis = [0, -1, 0], to = \"sun\" }, \
                       star = { right_ascension_deg = 10, declination_deg = -20 } }";
        assert_eq!(command(written), aligned_command(&axes));
        // A quarter turn about Z: the body's X stands along Y of EME2000.
        let half = core::f64::consts::FRAC_1_SQRT_2;
        let held = command(&format!("[0, 0, {half}, {half}]"));
        let pointing = held.aimpoint.vector.cross(&held.external_roll.vector);
        assert!((pointing - Vector3::z().cross(&Vector3::x())).norm() < 1e-15, "{held:?}");
    }

    #[test]
    fn commands_have_names() {
        let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
        let text = "[[command]]\nat = 0\nname = \"relay\"\nscenario = \"downlink\"\n[[command]]\nat = 1\nscenario = \"plusZ\"\n\
                    aimpoint = { option = \"earth\" }\n[[command]]\nat = 2\nattitude = \"sunPointing\"\n\
                    [[command]]\nat = 3\nattitude = [0, 0, 0, 1]\n[[command]]\nat = 4\nkeepIn = { enabled = false }\n";
        let timeline = Timeline::of_plant("t.toml", text, &spacecraft).unwrap();
        assert_eq!(timeline.names, ["relay", "plusZ", "sunPointing", "inertial", "guided"]);
    }
}
