//! Ephemeris of bodies over a span, from a flight or from kernels, as the text of its file.

use isolation::interrupt;
use packing::carried::ephemeris::{FILE, table};
use physics::{
    environment::onboard::{OnboardEphemeris, OnboardTarget, to_toml},
    numerics::Span,
};

use super::{EphemerisRequest, Failure, Source, coarse, flight::RepeatableSimulation, precise, spk::Kernels};

/// Text of the file and a table of its contents; `None` after Ctrl-C.
///
/// # Errors
/// States that the source does not have, and fits beyond the tolerance.
pub fn fit(request: &EphemerisRequest) -> Result<Option<(String, String)>, Failure> {
    let source = source(request)?;
    let mut made = OnboardEphemeris { source: Some(source.title()), ..OnboardEphemeris::default() };
    for target in &request.targets {
        made.precise.push(precise(&*source, *target, request)?);
        if interrupt::raised() {
            return Ok(None);
        }
    }
    if let Some(until_s) = request.coarse_until_s {
        let span = Span::new(request.span_s[0], until_s);
        made.coarse = coarse(&*source, &request.targets, span, request.is_quiet)?;
    }
    let text = terminal::unsigned_zeros(&to_toml(&made)).into_owned();
    // What a spacecraft will read is what was made.
    if OnboardEphemeris::from_toml(FILE, &text).map_err(|error| error.to_string())? != made {
        return Err("the file does not read back as it was made".into());
    }
    let table = table(&made, text.len());
    Ok(Some((text, table)))
}

/// Source of the states: kernels if there are any, otherwise a flight.
fn source(request: &EphemerisRequest) -> Result<Box<dyn Source>, Failure> {
    let [start_s, stop_s] = request.span_s;
    if request.kernels.is_empty() {
        return Ok(Box::new(RepeatableSimulation::open(&request.fmu, &request.set, start_s)?));
    }
    let mut targets = request.targets.clone();
    if request.coarse_until_s.is_some() {
        targets.extend([OnboardTarget::Sun, OnboardTarget::Earth]);
    }
    let span_s = [start_s, request.coarse_until_s.unwrap_or(stop_s)];
    let kernels = Kernels::open(&request.kernels, request.center, request.spacecraft, &targets, span_s)?;
    Ok(Box::new(kernels))
}
