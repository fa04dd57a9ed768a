//! The files of a map: picture, torque by direction, lines of zero torque.

use std::path::{Path, PathBuf};

use files::Destination;
use fmi::csv::Real;
use inputs::ending::{OPTION, by_ending};

use super::{found::Found, options::Map, picture, spacecraft::MappedSpacecraft};
use crate::{
    text_table::csv,
    torque_map::{Angles, direction},
};

/// Options that name the files.
const OPTIONS: [&str; 3] = [OPTION, OPTION, "--lines"];
const AXES: [&str; 3] = ["x", "y", "z"];

/// Destinations of picture, torque, lines.
pub(super) struct Outputs([Option<Destination>; 3]);

/// Files that were written.
pub(super) struct Written {
    pub takes_stdout: bool,
    pub files: Vec<String>,
}

impl Outputs {
    /// Looks at every file before anything is computed.
    pub(super) fn open(arguments: &Map) -> Result<Self, String> {
        let inputs: Vec<&Path> =
            [arguments.spacecraft.as_path()].into_iter().chain(arguments.recording.as_deref()).collect();
        let [table, picture] = by_ending(&arguments.output, ["csv", "svg"])?;
        let is_drawn = arguments.output.is_empty() && !arguments.no_picture;
        let picture = picture.map(Path::to_owned).or_else(|| is_drawn.then(|| usual_picture(arguments)));
        let mut opened = [None, None, None];
        let paths = [picture.as_deref(), table, arguments.lines.as_deref()];
        for (opened, (path, option)) in opened.iter_mut().zip(paths.into_iter().zip(OPTIONS)) {
            *opened = path.map(|path| Destination::open(path, option, &inputs)).transpose()?;
        }
        let named: Vec<_> =
            opened.iter().zip(OPTIONS).filter_map(|(it, option)| Some((it.as_ref()?, option))).collect();
        for (k, (one, option)) in named.iter().enumerate() {
            if let Some((_, other)) = named[k + 1..].iter().find(|(other, _)| one.is_same(other)) {
                return Err(format!("one file cannot take both: see {option} and {other}"));
            }
        }
        Ok(Self(opened))
    }

    /// Writes all of them.
    pub(super) fn write(self, spacecraft: &MappedSpacecraft, found: &Found) -> Result<Written, String> {
        let mut written = Written { takes_stdout: false, files: Vec::new() };
        let contents: [&dyn Fn() -> String; 3] =
            [&|| picture::svg(spacecraft, found), &|| torque(spacecraft, found), &|| lines(found)];
        for (opened, content) in self.0.into_iter().zip(contents) {
            let Some(destination) = opened else { continue };
            match destination.is_stdout() {
                true => written.takes_stdout = true,
                false => written.files.push(destination.path().display().to_string()),
            }
            destination.fill(|file| file.write_all(content().as_bytes()))?;
        }
        Ok(written)
    }
}

fn usual_picture(arguments: &Map) -> PathBuf {
    let stem = arguments.spacecraft.file_stem().unwrap_or_default().to_string_lossy();
    PathBuf::from(format!("{stem}-map.svg"))
}

/// A row for each direction; 180 deg of azimuth is -180 deg.
fn torque(spacecraft: &MappedSpacecraft, found: &Found) -> String {
    let mut header = "sun_azimuth_deg,sun_elevation_deg".to_owned();
    for (what, unit) in [("torque", "n_m"), ("force", "n")] {
        header.extend(AXES.map(|axis| format!(",{what}_{axis}_{unit}")));
    }
    let panels = &spacecraft.lit.panels;
    header.extend((1..=panels.len()).map(|number| format!(",panel_{number}_angle_deg")));
    let nodes = found.sphere.grid.nodes().filter(|(place_deg, _)| place_deg[0] < 180.0);
    let rows = nodes.map(|(place_deg, load)| {
        let sun = direction(place_deg);
        let loads = [load.torque_n_m, load.force_n].into_iter().flat_map(<[f64; 3]>::from);
        let angles_deg = panels.iter().map(move |turned| turned.angle_rad(&sun).to_degrees());
        place_deg.into_iter().chain(loads).chain(angles_deg).map(Real)
    });
    csv(&header, rows)
}

/// A row for each place of each line and for each balance, of all directions and of the zone.
fn lines(found: &Found) -> String {
    let mut text = "region,axis,line,sun_azimuth_deg,sun_elevation_deg\n".to_owned();
    let mut row = |region: &str, axis: &str, line: usize, [azimuth_deg, elevation_deg]: Angles| {
        let (azimuth, elevation) = (Real(azimuth_deg), Real(elevation_deg));
        text.push_str(&format!("{region},{axis},{line},{azimuth},{elevation}\n"));
    };
    let zone = found.zone.iter().map(|zone| ("zone", zone));
    for (region, mapped) in core::iter::once(("all", &found.sphere)).chain(zone) {
        for (lines, axis) in mapped.lines.iter().zip(AXES) {
            for (index, line) in lines.iter().enumerate() {
                line.places_deg.iter().for_each(|place_deg| row(region, axis, index + 1, *place_deg));
            }
        }
        for (index, balance) in mapped.balances.iter().enumerate() {
            row(region, "xz", index + 1, balance.place_deg);
        }
    }
    text
}
