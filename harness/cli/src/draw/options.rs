//! Options of `heliotorque draw`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use drawing::scenes::PanelAngle;
use inputs::values::angle;

/// Shown with the help.
const EXAMPLE: &str = "\
Example:
  heliotorque draw my.toml                                   writes my.svg, three views and a perspective
  heliotorque draw my.toml --view perspective --angle +X=30deg --angle -X=-30deg --output turned.svg";

/// `heliotorque draw`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Draw {
    /// The spacecraft, a TOML file as for `pack`. A surface with `polygon_m` is drawn as that outline, any other as a square of
    /// its area about its centre
    pub spacecraft: PathBuf,
    /// Show these views only: front (from the Sun, -Y), side (from +X), top (from +Z), perspective, all
    #[arg(
        long,
        value_enum,
        value_name = "VIEWS",
        value_delimiter = ',',
        default_value = "all",
        hide_possible_values = true
    )]
    pub view: Vec<ViewKind>,
    /// Turn a panel to this angle, in deg or rad: +X=30deg; without a name every panel; repeatable. Otherwise panels stand as
    /// the file says with the Sun along -Y
    #[arg(long, value_name = "PANEL=ANGLE", value_parser = panel_angle, allow_hyphen_values = true)]
    pub angle: Vec<PanelAngle>,
    /// The SVG to write; otherwise the file's name with .svg, in this folder; - is the standard output
    #[arg(long, short, value_name = "SVG")]
    pub output: Option<PathBuf>,
}

/// `--view` of `draw`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ViewKind {
    /// From -Y, where the Sun is
    Front,
    /// From +X
    Side,
    /// From +Z
    Top,
    /// From a corner
    Perspective,
    /// All of them
    All,
}

/// `panel=angle`, or an angle for every panel.
fn panel_angle(text: &str) -> Result<PanelAngle, String> {
    match text.rsplit_once('=') {
        Some((panel, turn)) => {
            Ok(PanelAngle { panel: Some(panel.trim().to_owned()), angle_rad: angle(turn)? })
        }
        None => Ok(PanelAngle { panel: None, angle_rad: angle(text)? }),
    }
}

#[cfg(test)]
mod tests {
    //! Panels are named before the last equals sign.
    use super::*;

    #[test]
    fn angles_are_of_one_panel_or_of_all() {
        let of = |text: &str| panel_angle(text).map(|it| (it.panel, it.angle_rad));
        assert_eq!(of("+X=1.5rad"), Ok((Some("+X".to_owned()), 1.5)));
        assert_eq!(of("a=b = -0.5 rad"), Ok((Some("a=b".to_owned()), -0.5)));
        assert_eq!(of("0deg"), Ok((None, 0.0)));
        for bad in ["", "+X", "+X=", "+X=10", "infdeg", "=nanrad"] {
            assert!(of(bad).is_err(), "{bad}");
        }
    }
}
