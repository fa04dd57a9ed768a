//! `heliotorque draw`: a spacecraft's file as a picture, three views and a perspective.

mod options;

use std::path::Path;

use drawing::scenes::{self, View};
use files::{
    Destination,
    outcome::{self, Outcome},
};
use inputs::{ending::check_ending, kind::FileKind};

pub(crate) use options::Draw;
use options::ViewKind;

/// Draws the file.
pub(crate) fn run(arguments: &Draw) -> Outcome {
    let own = || Path::new(arguments.spacecraft.file_name().unwrap_or_default()).with_extension("svg");
    let path = arguments.output.clone().unwrap_or_else(own);
    check_ending(&path, "svg")?;
    let (file, text) =
        (arguments.spacecraft.display().to_string(), FileKind::Spacecraft.read(&arguments.spacecraft)?);
    let scene = scenes::read(&file, &text, &arguments.angle)?;
    let views: Vec<View> =
        View::ALL.into_iter().filter(|view| is_requested(*view, &arguments.view)).collect();
    let svg = scenes::sheet_svg(&scene, &views).ok_or_else(|| {
        format!("{file}: found no surface and no thruster with an extent, allowed: at least one to draw")
    })?;
    let destination = Destination::open(&path, "--output", &[&arguments.spacecraft])?;
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
