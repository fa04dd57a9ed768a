//! A spacecraft's or a spinner's file as a picture: three views and a perspective.

mod devices;
mod pane;
mod parts;
mod scene;
mod sheet;
mod surface;

use physics::{
    spacecraft::{Panel, Spacecraft},
    spin::spinner::Spinner,
    toml::FileError,
};
use toml::de::DeTable;

pub use parts::{Part, panel_called};
pub use scene::{Scene, dish_of};
pub use sheet::{View, svg as sheet_svg};

/// An angle of one panel, or of all.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelAngle {
    /// The panel's name.
    pub panel: Option<String>,
    /// Right-handed about its axis, in rad.
    pub angle_rad: f64,
}

/// Width and height of an FMU's picture, in px.
const PICTURE: (f64, f64) = (480.0, 320.0);
/// Keys that only a spinner's file has.
const SPINNER_KEYS: [&str; 3] = ["thruster", "damper", "star_tracker"];

/// All views of a file; `None` where no reader takes it, as the library that packs it reports.
pub fn svg(text: &str) -> Option<String> {
    sheet::svg(&read("", text, &[]).ok()?, &View::ALL)
}

/// The perspective as PNG; `None` as above.
pub fn png(text: &str) -> Option<Vec<u8>> {
    crate::png(&sheet::picture(&read("", text, &[]).ok()?, PICTURE)?)
}

/// The scene of a spacecraft's or a spinner's file.
///
/// # Errors
/// A file that its reader refuses, and an angle of a panel that it does not have.
pub fn read(file: &str, text: &str, angles: &[PanelAngle]) -> Result<Scene, Box<dyn std::error::Error>> {
    let is_spinner =
        SPINNER_KEYS.iter().any(|key| DeTable::parse_recoverable(text).0.get_ref().contains_key(*key));
    if is_spinner {
        let spinner = Spinner::parse(file, text).map_err(refusal)?;
        return match angles {
            [] => Ok(Scene::of_spinner(&spinner)),
            [first, ..] => Err(no_panel(first, &[]).into()),
        };
    }
    let spacecraft = Spacecraft::from_toml(file, text).map_err(refusal)?;
    let mut angles_rad = vec![None; spacecraft.panels.len()];
    for angle in angles {
        let is_meant =
            |panel: &Panel| angle.panel.as_ref().is_none_or(|name| name.eq_ignore_ascii_case(&panel.name));
        if !spacecraft.panels.iter().any(is_meant) {
            return Err(no_panel(angle, &spacecraft.panels).into());
        }
        for (angle_rad, _) in
            angles_rad.iter_mut().zip(&spacecraft.panels).filter(|(_, panel)| is_meant(panel))
        {
            *angle_rad = Some(angle.angle_rad);
        }
    }
    Ok(Scene::of_spacecraft(&spacecraft, &angles_rad))
}

fn refusal(error: FileError) -> String {
    format!("{error}\nsee `heliotorque check`")
}

fn no_panel(angle: &PanelAngle, panels: &[Panel]) -> String {
    let found =
        angle.panel.as_ref().map_or_else(|| "an angle".to_owned(), |name| format!("the panel {name:?}"));
    let names: Vec<&str> = panels.iter().map(|panel| panel.name.as_str()).collect();
    match names[..] {
        [] => format!("--angle: found {found}, allowed: none, the file has no panels"),
        _ => format!("--angle: found {found}, allowed: {}", names.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    //! Every file that is drawn has a picture, anything else none.
    use physics::spacecraft::MESSENGER_TOML;

    use super::*;

    #[test]
    fn spacecraft_and_spinners_become_a_picture() {
        let outlines = include_str!("../../../../fmu-src/resources/examples/mercury-orbiter.toml");
        let spinner = include_str!("../../../../fmu-src/resources/ace.toml");
        for text in [MESSENGER_TOML, outlines, spinner] {
            let png = png(text).unwrap();
            assert_eq!(&png[1..4], b"PNG");
            assert_eq!(png[16..24], [0, 0, 1, 0xe0, 0, 0, 1, 0x40], "480 by 320");
        }
        for text in ["", "plates = 3", "not toml [", "[[plates]]\narea_m2 = -1", "[[thruster]]"] {
            assert!(png(text).is_none() && svg(text).is_none(), "{text}");
        }
    }
}
