//! Options of `heliotorque map`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use inputs::values::{angle, number};
use planner::map::options::{self, Steps};

use crate::patience::Reader;

/// Shown with the help.
const EXAMPLE: &str = "\
Torque about the centre of mass and force are in the body frame. Azimuth counts from -Y toward +X, elevation from the XY
plane toward -Z. Panels held by Sun offset turn with the Sun, as in MomentumPlant; the others keep their angle.

With --recording, the disturbance is what the recording gathers in body components: torque.total over time, otherwise
momentum.body with the dumps of dump.count taken out (run with momentum.convention=bodyIntegral). Downlinks take the share of
time of guided.downlinkStart|End|Every, and may hold the Sun anywhere in the zone instead of on -Y. \"Holdable without a dump
until day N\" means: up to day N some choice of these directions keeps X and Z within +-dump.threshold, from day N on none does.

Example:
  heliotorque map my.toml                                    writes my-map.svg and prints the table
  heliotorque map my.toml --distance 0.3 --panel-offset 70deg --output torque.csv --lines zero.csv
  heliotorque run dist/MomentumPlant.fmu --stop 90d --record torque.total,sun.distance --output simulated.csv
  heliotorque map fmu-src/resources/messenger.toml --recording simulated.csv";

/// `heliotorque map`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Map {
    /// The spacecraft, a TOML file as for `pack`, or an FMU that was packed with one
    pub spacecraft: PathBuf,
    /// Distance from the Sun, in AU; otherwise that of the file's sun.positionBody, without one the mean distance of the body
    /// that orbit.center names. Torque goes with the inverse square
    #[arg(long, value_name = "AU", value_parser = distance, allow_hyphen_values = true)]
    pub distance: Option<f64>,
    /// Angle between cells and Sun for every panel held by Sun offset, in deg or rad: 70deg; otherwise the file's
    #[arg(long, value_name = "ANGLE", value_parser = offset, allow_hyphen_values = true)]
    pub panel_offset: Option<f64>,
    /// Greatest azimuth and elevation of the Sun keep-in zone, in deg or rad: 15deg,13deg; otherwise that of
    /// MomentumPlant's keepIn.azimuth and keepIn.elevation, none at 180deg,90deg
    #[arg(long, value_name = "AZIMUTH,ELEVATION", value_parser = zone, allow_hyphen_values = true)]
    pub zone: Option<[f64; 2]>,
    /// Azimuth and elevation of the Sun at which a degree is weighed, in deg or rad: 20deg,-5deg; otherwise where the attitude of
    /// MomentumPlant has it at the start
    #[arg(long, value_name = "AZIMUTH,ELEVATION", value_parser = sun, allow_hyphen_values = true)]
    pub sun: Option<[f64; 2]>,
    /// Spacing of the directions, in deg or rad, a whole part of 90 deg, at least 0.2 deg
    #[arg(long, value_name = "ANGLE", value_parser = steps, allow_hyphen_values = true, default_value = "1deg")]
    pub step: Steps,
    /// What is mapped: solar, the sunlight alone; or total, with the recoil of the heat that sunlight brings
    #[arg(long, value_enum, default_value = "solar", hide_possible_values = true)]
    pub source: SourceKind,
    /// Set a parameter or input of DisturbanceTorque, or of MomentumPlant where that has it alone (keepIn.*, guided.*,
    /// dump.threshold, panel[k].sunOffset); repeatable, written as for `run`: 'spacecraft.centerOfMass[3]=-2.54cm'
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// A simulated mission, recorded by `run`: torque.total, or momentum.body with dump.count; with sun.distance, what downlinks
    /// give follows the distance
    #[arg(long, value_name = "CSV")]
    pub recording: Option<PathBuf>,
    /// The file to write, by its ending: .csv, torque (N.m), force (N) and panel angles (deg) for every direction (deg); .svg, the
    /// picture; repeatable, otherwise the file's name with -map.svg, in this folder; - is CSV on the standard output
    #[arg(long, short, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// Write the lines of zero torque as CSV: region (all, zone), axis (x, y, z, or xz where X and Z vanish together), number,
    /// azimuth and elevation in deg; what vanishes does to 1e-12 of its greatest; - is the standard output
    #[arg(long, value_name = "CSV")]
    pub lines: Option<PathBuf>,
    /// Write no picture
    #[arg(long, conflicts_with = "output")]
    pub no_picture: bool,
    /// Print no table
    #[arg(long, short)]
    pub quiet: bool,
    /// The library that reads the file
    #[command(flatten)]
    pub reader: Reader,
}

impl Map {
    /// The request without the command line.
    pub(crate) fn request(&self) -> planner::map::Map {
        let it = self.clone();
        planner::map::Map {
            spacecraft: it.spacecraft,
            template: it.reader.template,
            distance: it.distance,
            panel_offset: it.panel_offset,
            zone: it.zone,
            sun: it.sun,
            step: it.step,
            source: it.source.kind(),
            set: it.set,
            recording: it.recording,
            output: it.output,
            lines: it.lines,
            no_picture: it.no_picture,
            quiet: it.quiet,
        }
    }
}

/// `--source`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SourceKind {
    /// Sunlight
    Solar,
    /// Sunlight and recoil
    Total,
}

impl SourceKind {
    fn kind(self) -> options::SourceKind {
        match self {
            Self::Solar => options::SourceKind::Solar,
            Self::Total => options::SourceKind::Total,
        }
    }
}

fn distance(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let is_allowed = |distance_au| (0.01..=1000.0).contains(&distance_au);
    number(text.strip_suffix("AU").unwrap_or(text), is_allowed, "a number of AU from 0.01 to 1000: 0.3")
}

fn offset(text: &str) -> Result<f64, String> {
    match angle(text)? {
        offset_rad if offset_rad.abs() <= core::f64::consts::PI => Ok(offset_rad),
        _ => Err("allowed is -180 to 180 deg".to_owned()),
    }
}

fn zone(text: &str) -> Result<[f64; 2], String> {
    const ALLOWED: &str = "allowed are two angles, azimuth above 0 up to 180 deg and elevation above 0 up to 90 deg: \
                           15deg,13deg";
    let limits_rad = pair(text).ok_or(ALLOWED)??;
    let is_allowed = |angle_rad: f64, most_deg: f64| angle_rad > 0.0 && angle_rad <= most_deg.to_radians();
    if is_allowed(limits_rad[0], 180.0) && is_allowed(limits_rad[1], 90.0) {
        return Ok(limits_rad);
    }
    Err(ALLOWED.to_owned())
}

fn sun(text: &str) -> Result<[f64; 2], String> {
    const ALLOWED: &str =
        "allowed are two angles, azimuth from -180 to 180 deg and elevation from -90 to 90 deg: 20deg,-5deg";
    let place_rad = pair(text).ok_or(ALLOWED)??;
    let is_allowed = |angle_rad: f64, most_deg: f64| angle_rad.abs() <= most_deg.to_radians();
    if is_allowed(place_rad[0], 180.0) && is_allowed(place_rad[1], 90.0) {
        return Ok(place_rad);
    }
    Err(ALLOWED.to_owned())
}

/// Two angles with a comma between them, in rad.
fn pair(text: &str) -> Option<Result<[f64; 2], String>> {
    let (azimuth, elevation) = text.split_once(',')?;
    Some(angle(azimuth).and_then(|azimuth| Ok([azimuth, angle(elevation)?])))
}

fn steps(text: &str) -> Result<Steps, String> {
    let count = 90.0 / angle(text)?.to_degrees();
    if (1.0..=450.0 + 1e-6).contains(&count) && (count - count.round()).abs() < 1e-6 {
        return Ok(Steps(count.round() as u32));
    }
    Err("allowed is a whole part of 90 deg from 0.2 deg on: 0.5deg, 1deg, 5deg".to_owned())
}

#[cfg(test)]
mod tests {
    //! Ranges are as the help says.
    use super::*;

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(distance("0.3"), Ok(0.3));
        assert_eq!(distance("0.3 AU"), Ok(0.3));
        for bad in ["nan", "NaN", "0", "-1", "inf", "near", ""] {
            assert!(distance(bad).is_err(), "{bad}");
        }
        assert_eq!(zone("180deg,90deg"), Ok([core::f64::consts::PI, core::f64::consts::FRAC_PI_2]));
        for bad in ["0deg,13deg", "15deg", "15deg,0deg", "15deg,91deg", "15,13", "nandeg,1deg", "-1deg,1deg"]
        {
            assert!(zone(bad).is_err(), "{bad}");
        }
        assert_eq!(sun("-180deg,-90deg"), Ok([-core::f64::consts::PI, -core::f64::consts::FRAC_PI_2]));
        for bad in ["0deg", "181deg,0deg", "0deg,91deg", "15,13", "nandeg,1deg"] {
            assert!(sun(bad).is_err(), "{bad}");
        }
        assert_eq!(steps("1deg"), Ok(Steps(90)));
        assert_eq!(steps("0.2deg"), Ok(Steps(450)));
        for bad in ["0deg", "7deg", "-1deg", "nandeg", "0.1deg", "0.01deg", "180deg", "1"] {
            assert!(steps(bad).is_err(), "{bad}");
        }
        for bad in ["-181deg", "181deg", "65"] {
            assert!(offset(bad).is_err(), "{bad}");
        }
    }
}
