//! Options of `heliotorque plan spin`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use inputs::values::duration;
use model_description::quantity;
use planner::spin::{ALLOWED_DATE, RightAscensionDeclination, Timing, TurnRequest, epoch_s};

use crate::patience::Patience;

/// Reference by which pulses are timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TimingOption {
    /// Fixed intervals of the assumed spin period
    Clock,
    /// A delay after each Sun crossing
    Sun,
    /// The exact phase, each turn
    Phase,
}

impl TimingOption {
    fn timing(self) -> Timing {
        match self {
            Self::Clock => Timing::Clock,
            Self::Sun => Timing::SunCrossing,
            Self::Phase => Timing::TruePhase,
        }
    }
}

/// An angle with its unit, in deg.
fn angle(text: &str) -> Result<f64, String> {
    quantity::read_shown(text, "rad", "deg")
        .ok_or_else(|| "an angle carries its unit: 2deg, 0.035rad".to_owned())
}

/// Right ascension and declination with their units and a comma between.
fn direction(text: &str) -> Result<RightAscensionDeclination, String> {
    const ALLOWED: &str = "allowed: right ascension (-360 to 360 deg) and declination (-90 to 90 deg), each with its unit: \
                           83.63deg,22.01deg";
    let read = || {
        let (right_ascension, declination) = text.split_once(',')?;
        Some(RightAscensionDeclination {
            right_ascension_deg: angle(right_ascension).ok().filter(|deg| deg.abs() <= 360.0)?,
            declination_deg: angle(declination).ok().filter(|deg| deg.abs() <= 90.0)?,
        })
    };
    read().ok_or_else(|| ALLOWED.to_owned())
}

/// A rate of turn with its unit, in rpm.
fn rate(text: &str) -> Result<f64, String> {
    quantity::read_shown(text, "rad/s", "rpm")
        .ok_or_else(|| "a rate carries its unit: 5rpm, 30deg/s".to_owned())
}

/// A date in seconds past J2000 TDB.
fn date(text: &str) -> Result<f64, String> {
    epoch_s(text).map_err(|error| format!("{error}, allowed: {ALLOWED_DATE}"))
}

/// `heliotorque plan spin`.
#[derive(Clone, Debug, Args)]
pub(crate) struct SpinPlan {
    /// Angle by which the spin axis shall turn, above 0 to 175 deg; see --direction, --target
    #[arg(long = "angle", value_name = "ANGLE", value_parser = angle, default_value = "2deg")]
    pub angle_deg: f64,
    /// Way of that turn about the spin axis, right-handed from the Sun: 0 toward it, 180deg away, otherwise across
    #[arg(long = "direction", value_name = "ANGLE", value_parser = angle, default_value = "-90deg")]
    pub direction_deg: f64,
    /// Turn to here instead: right ascension and declination (EME2000), 83.63deg,22.01deg; the Sun by --date or --sun
    #[arg(long, value_name = "RA,DEC", value_parser = direction, conflicts_with_all = ["angle_deg", "direction_deg", "sun_angle_deg"])]
    pub target: Option<RightAscensionDeclination>,
    /// Direction of the spin axis at the start; otherwise by start.q in the spacecraft's file
    #[arg(long, value_name = "RA,DEC", value_parser = direction)]
    pub from: Option<RightAscensionDeclination>,
    /// Date of the turn, which gives Sun and Earth as seen from the Sun-Earth L1 point: '2026-11-22T12:00:00 UTC'
    #[arg(long, value_name = "DATE", value_parser = date, conflicts_with = "sun_angle_deg")]
    pub date: Option<f64>,
    /// Direction of the Sun, in place of --date
    #[arg(long, value_name = "RA,DEC", value_parser = direction, conflicts_with = "sun_angle_deg")]
    pub sun: Option<RightAscensionDeclination>,
    /// Direction of the Earth, in place of --date: off L1 it is up to 15 deg elsewhere
    #[arg(long, value_name = "RA,DEC", value_parser = direction)]
    pub earth: Option<RightAscensionDeclination>,
    /// Trains that move by whole pulses may miss the angle by this much, in per cent
    #[arg(long = "angle-tolerance", value_name = "PERCENT", default_value_t = 2.0)]
    pub angle_tolerance_percent: f64,
    /// Inertia ratio I3/IT, between 1 and 2; otherwise the spacecraft's at its propellant load
    #[arg(long, value_name = "RATIO")]
    pub ratio: Option<f64>,
    /// The ratio may be off by this much either way
    #[arg(long, value_name = "RATIO", default_value_t = 0.0115)]
    pub ratio_uncertainty: f64,
    /// Spin rate: 5rpm; otherwise spin.initialRate in the spacecraft's [start], or its nominal rate
    #[arg(long = "rate", value_name = "RATE", value_parser = rate)]
    pub rate_rpm: Option<f64>,
    /// The spin rate may be off by this much either way: 0.1rpm
    #[arg(long = "rate-uncertainty", value_name = "RATE", value_parser = rate, default_value = "0")]
    pub rate_uncertainty_rpm: f64,
    /// Thruster or group, by its name in the spacecraft's file; otherwise the first that tilts the spin axis alone
    #[arg(long, value_name = "NAME")]
    pub thruster: Option<String>,
    /// Reference by which pulses are timed
    #[arg(long, value_enum, default_value_t = TimingOption::Sun)]
    pub timing: TimingOption,
    /// Angle from the spin axis to the Sun: sets the nutation that science bears; otherwise by --date or --sun
    #[arg(long = "sun-angle", value_name = "ANGLE", value_parser = angle, default_value = "10deg")]
    pub sun_angle_deg: f64,
    /// Limit on nutation at any time
    #[arg(long = "max-nutation", value_name = "ANGLE", value_parser = angle)]
    pub max_nutation_deg: Option<f64>,
    /// Limit on nutation after the last pulse
    #[arg(long = "max-final", value_name = "ANGLE", value_parser = angle)]
    pub max_final_deg: Option<f64>,
    /// Limit on the time from first to last pulse, in s or with a unit: 10min
    #[arg(long = "max-duration", value_name = "TIME", value_parser = duration)]
    pub max_duration_s: Option<f64>,
    /// Propellant on board, in kg; otherwise the spacecraft's
    #[arg(long = "propellant", value_name = "KG")]
    pub propellant_kg: Option<f64>,
    /// The spacecraft, a TOML file; otherwise ACE
    #[arg(long, value_name = "TOML")]
    pub spacecraft: Option<PathBuf>,
    /// Run the best plan through this SpinPlant, over the range of ratios; otherwise dist/SpinPlant.fmu where there is
    /// one
    #[arg(long, value_name = "FMU")]
    pub template: Option<PathBuf>,
    /// Plan antenna pointing for so long, up to 3653d, instead of one manoeuvre; limits hold for each of its turns
    #[arg(
        long = "campaign",
        value_name = "TIME",
        value_parser = duration,
        conflicts_with_all = [
            "angle_deg", "direction_deg", "target", "from", "date", "sun", "earth", "angle_tolerance_percent",
            "sun_angle_deg", "template", "rows", "output"
        ]
    )]
    pub campaign_s: Option<f64>,
    /// Rows of the trade table, the last of them the uniform plan (equal pulses of one step, once a turn); 0 for no table
    #[arg(long, value_name = "COUNT", default_value_t = 12)]
    pub rows: usize,
    /// Write the plan here: burn.csv and burn.json (pulse by pulse), start.toml (start values), burn.svg (axis and nutation)
    #[arg(long, short, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Time for the FMU
    #[command(flatten)]
    pub patience: Patience,
}

impl SpinPlan {
    /// The request without the command line.
    pub(super) fn request(&self) -> TurnRequest {
        let it = self.clone();
        TurnRequest {
            angle_deg: it.angle_deg,
            direction_deg: it.direction_deg,
            target: it.target,
            from: it.from,
            date: it.date,
            sun: it.sun,
            earth: it.earth,
            angle_tolerance_percent: it.angle_tolerance_percent,
            ratio: it.ratio,
            ratio_uncertainty: it.ratio_uncertainty,
            rate_rpm: it.rate_rpm,
            rate_uncertainty_rpm: it.rate_uncertainty_rpm,
            thruster: it.thruster,
            timing: it.timing.timing(),
            sun_angle_deg: it.sun_angle_deg,
            max_nutation_deg: it.max_nutation_deg,
            max_final_deg: it.max_final_deg,
            max_duration_s: it.max_duration_s,
            propellant_kg: it.propellant_kg,
            spacecraft: it.spacecraft,
            template: it.template,
            campaign_s: it.campaign_s,
            rows: it.rows,
            output: it.output,
        }
    }
}

#[cfg(test)]
mod tests {
    //! Quantities carry their units; what contradicts one another is refused.
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        plan: SpinPlan,
    }

    fn refused(words: &[&str]) -> String {
        let parsed = Line::try_parse_from([&["plan"], words].concat());
        parsed.err().map_or_else(String::new, |error| error.to_string())
    }

    #[test]
    fn a_request_has_what_was_written() {
        let words = [
            "plan",
            "--angle",
            "0.5rad",
            "--target=-10deg,20deg",
            "--rate",
            "30deg/s",
            "--max-duration",
            "9min",
        ];
        let given = |words: &[&str]| Line::parse_from(words.iter().copied()).plan.request();
        let default = given(&words[..1]);
        assert_eq!((default.angle_deg, default.direction_deg, default.rows), (2.0, -90.0, 12));
        assert_eq!((default.timing, default.rate_uncertainty_rpm), (Timing::SunCrossing, 0.0));
        assert_eq!(given(&words[..3]).angle_deg, 0.5_f64.to_degrees());
        let target = given(&[&words[..1], &words[3..]].concat());
        assert!((target.rate_rpm.unwrap() - 5.0).abs() < 1e-12 && target.max_duration_s == Some(540.0));
        let expected = RightAscensionDeclination { right_ascension_deg: -10.0, declination_deg: 20.0 };
        assert_eq!(target.target, Some(expected));
    }

    #[test]
    fn flags_of_one_manoeuvre_do_not_go_with_a_campaign() {
        for flag in
            ["--angle=3deg", "--angle-tolerance=1", "--sun-angle=5deg", "--template=x.fmu", "--rows=3"]
        {
            let error = refused(&["--campaign", "10d", flag]);
            assert!(error.contains("cannot be used with") && error.contains(&flag[..5]), "{error}");
            assert_eq!(refused(&[flag]), "");
        }
    }

    #[test]
    fn what_is_no_quantity_or_goes_with_no_other_is_refused() {
        for (words, part) in [
            (["--target", "10deg"].as_slice(), "right ascension"),
            (&["--target", "10,20"], "each with its unit"),
            (&["--rate", "5"], "5rpm"),
            (&["--from", "400deg,0deg"], "right ascension"),
            (&["--sun", "0deg,91deg"], "declination (-90 to 90 deg)"),
            (&["--date", "yesterday"], "UTC"),
            (&["--target", "1deg,2deg", "--angle", "3deg"], "cannot be used with"),
            (&["--target", "1deg,2deg", "--direction", "3deg"], "cannot be used with"),
            (&["--sun", "1deg,2deg", "--sun-angle", "3deg"], "cannot be used with"),
            (&["--campaign", "3d", "--output", "x"], "cannot be used with"),
        ] {
            let text = refused(words);
            assert!(text.contains(part), "{words:?}: {text}");
        }
    }
}
