//! Trains sized by the angle that they are to move the momentum by.

use super::{
    burn_error::{BurnError, ParameterError},
    forecast::ForecastCase,
    train::{LEAST_OF_SPLIT, MOST_ORDER, MOST_PULSES, Pulses, Shape, Train},
};

/// The train whose move is nearest to `angle_rad`: a train long enough to have a plateau, and more plateau pulses.
///
/// # Errors
/// No train of these pulses moves the momentum by that angle.
pub fn sized(pulses: &Pulses, flight: &ForecastCase, angle_rad: f64) -> Result<Train, BurnError> {
    let spin = &flight.spin;
    let make = |count: u32| Train::new(pulses, count, spin);
    let moved = |train: &Train| train.manoeuvre_rad(spin, flight.torque_n_m);
    // Shapes have at most 13 pulses before the plateau, so one short train makes the general case.
    let mut short = None;
    for count in 1..=2 * MOST_ORDER + 2 {
        if let Ok(train) = make(count) {
            let miss = (moved(&train) - angle_rad).abs();
            if short.is_none_or(|(_, best)| miss < best) {
                short = Some((train, miss));
            }
        }
    }
    let Some((short, miss)) = short else {
        return Err(make(2 * MOST_ORDER + 2).map_or_else(BurnError::Train, |_| too_long(angle_rad)));
    };
    let Ok(base) = make(2 * MOST_ORDER + 2) else { return Ok(short) };
    let step = if base.shape == Shape::Split { 2.0 } else { 1.0 };
    let plateau = spin.manoeuvre_rad(flight.torque_n_m, base.plateau_width_s());
    let more = ((angle_rad - moved(&base)) / (plateau * step)).round().max(0.0);
    let count = f64::from(base.count) + more * step;
    if count.is_nan() || count > f64::from(MOST_PULSES) {
        return Err(too_long(angle_rad));
    }
    let is_split = base.shape == Shape::Split;
    let long = if is_split {
        // How far its halves are off depends on their length: the least off of those that move by the angle.
        let longest = (angle_rad / plateau / LEAST_OF_SPLIT).min(f64::from(MOST_PULSES)) as u32;
        let miss = |train: &Train| (moved(train) - angle_rad).abs();
        let cost = |train: &Train| (miss(train).max(plateau), train.offset_turns(0).abs());
        let trains = (count as u32..=longest).step_by(2).filter_map(|count| make(count).ok());
        let first = make(count as u32)?;
        trains.fold(first, |best, train| if cost(&train) < cost(&best) { train } else { best })
    } else {
        make(count as u32)?
    };
    let best = if (moved(&long) - angle_rad).abs() < miss { long } else { short };
    // Pulses come in pairs, so that a train may be off by one.
    if is_split && (moved(&best) - angle_rad).abs() > 1.5 * plateau {
        let found = format!("{angle_rad} rad");
        let most_deg = moved(&best).to_degrees();
        let allowed = format!(
            "the halves of a split train point too far apart with inertia ratio {}: the nearest it can do is {most_deg:.4} deg",
            spin.ratio
        );
        return Err(ParameterError::new("burn.angle", found, allowed).into());
    }
    Ok(best)
}

fn too_long(angle_rad: f64) -> BurnError {
    let allowed = "no train of this shape and width reaches it";
    ParameterError::new("burn.angle", format!("{angle_rad} rad"), allowed).into()
}
