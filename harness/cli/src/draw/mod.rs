//! `heliotorque draw`: a spacecraft's file as a picture, three views and a perspective.

mod options;

use std::path::{Path, PathBuf};

use drawing::scenes::{self, View};
use files::{
    Destination,
    outcome::{self, Outcome},
};
use inputs::{kind::FileKind, svg_path::check_svg_path};
use packing::check::DEFAULT_SPACECRAFT;

pub(crate) use options::Draw;
use options::ViewKind;

/// Name of the picture of the shipped spacecraft.
const DEFAULT_NAME: &str = "messenger";

/// Draws the file, or the shipped spacecraft.
pub(crate) fn run(arguments: &Draw) -> Outcome {
    let named = arguments.spacecraft.as_deref();
    let stem = named.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    let stem = stem.unwrap_or_else(|| DEFAULT_NAME.to_owned());
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}.svg")));
    check_svg_path(&path, "--output")?;
    let file = named.map_or_else(|| format!("{DEFAULT_NAME}.toml"), |path| path.display().to_string());
    let text =
        named.map_or_else(|| Ok(DEFAULT_SPACECRAFT.to_owned()), |path| FileKind::Spacecraft.read(path))?;
    let scene = scenes::read(&file, &text, &arguments.angle)?;
    let views: Vec<View> =
        View::ALL.into_iter().filter(|view| is_requested(*view, &arguments.view)).collect();
    let svg = scenes::sheet_svg(&scene, &views).ok_or_else(|| {
        format!("{file}: found no surface and no thruster with an extent, allowed: at least one to draw")
    })?;
    let inputs: Vec<&Path> = named.into_iter().collect();
    let destination = Destination::open(&path, "--output", &inputs)?;
    let drawn = format!("{}: {}, {} parts", path.display(), scene.name, scene.parts.len());
    outcome::written(destination, svg.as_bytes(), &drawn)
}

fn is_requested(view: View, requested: &[ViewKind]) -> bool {
    let kind = match view {
        View::Front => ViewKind::Front,
        View::Side => ViewKind::Side,
        View::Top => ViewKind::Top,
        View::Perspective => ViewKind::Perspective,
    };
    requested.contains(&kind) || requested.contains(&ViewKind::All)
}
