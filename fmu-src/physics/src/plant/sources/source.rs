//! Source: force and torque of one or more rows of the table of effects, with their law, settings, saved state and events.

use crate::loads::{Effect, Linear, Loads, Writer};
use crate::numerics::Span;
use crate::plant::instant::conditions::Conditions;
use crate::plant::instant::kinematics::Kinematics;
use crate::plant::settings::error::PlantError;
use crate::spacecraft::{Material, Spacecraft};

/// A source of loads. Its value holds models and caches, which follow from setup and settings and are not saved.
pub(crate) trait Source {
    /// Rows of the table that it writes. A row in the magnetic field is the only one of its source.
    const ROWS: &'static [Effect];
    /// Settings that it reads.
    type Settings;
    /// Saved state; `()` of a closed form.
    type State;

    /// Writes force and torque of its rows at one time, up to which the state is known; a row in the magnetic field needs nothing
    /// but [`Source::dipole`].
    fn load(
        &mut self,
        _settings: &Self::Settings,
        _state: &Self::State,
        _at: &Conditions<'_>,
        _results: &mut Results<'_>,
    ) {
    }

    /// Makes the state known from the start of a span on; returns up to when, at most to its end.
    ///
    /// # Errors
    /// What ends a flight.
    fn extend(
        &mut self,
        _state: &mut Self::State,
        _path: &mut Kinematics<'_>,
        span: Span,
    ) -> Result<f64, PlantError> {
        Ok(span.end_s)
    }

    /// Dipole at `time_s` and its rate, body frame, in A m2 and A m2/s, of a source whose row is in the magnetic field.
    fn dipole(_settings: &Self::Settings, _state: &Self::State, _time_s: f64) -> Linear {
        Linear::default()
    }

    /// Returns the time of the next event after `time_s`, in s; every segment ends there.
    fn next_event_s(_state: &Self::State, _time_s: f64) -> f64 {
        f64::INFINITY
    }

    /// Applies the events that are due at `time_s`; a second call at that time does nothing.
    fn apply_events(_state: &mut Self::State, _time_s: f64) {}

    /// Discards what was computed beyond `time_s`.
    fn cut(_state: &mut Self::State, _time_s: f64) {}

    /// Whether a simulation of this spacecraft can produce the state.
    fn is_valid(_state: &Self::State, _spacecraft: &Spacecraft) -> bool {
        true
    }

    /// Names the part of the state that was not computed at `time_s`, if any.
    fn first_uncovered(_state: &Self::State, _time_s: f64) -> Option<&'static str> {
        None
    }

    /// Units of work of a load, about microseconds.
    fn load_units(&self) -> u32 {
        0
    }

    /// Sets the material with this index; allocates nothing.
    fn set_material(&mut self, _index: usize, _material: &Material) {}
}

/// Results of the sources at one time.
pub(crate) struct Results<'a> {
    /// Force and torque by effect.
    pub loads: &'a mut Loads,
    /// Temperatures of the faces in K, which the air reads; empty where they are not known.
    pub face_temperatures_k: &'a mut Vec<f64>,
}

/// Compares the rows' writers with the rows of all sources, by name.
pub(super) const fn check_writers(sources: &[(&str, &[Effect])]) {
    let mut k = 0;
    while k < Effect::COUNT {
        let row = Effect::ALL[k];
        let (mut count, mut is_named, mut j) = (0, false, 0);
        while j < sources.len() {
            let ((name, rows), mut i) = (sources[j], 0);
            while i < rows.len() {
                if rows[i] as usize == row as usize {
                    count += 1;
                    is_named = matches!(row.row().writer, Writer::Source(writer) if equal(writer, name));
                    assert!(!row.is_in_field() || rows.len() == 1, "a source of a dipole writes one row");
                }
                i += 1;
            }
            j += 1;
        }
        match row.row().writer {
            Writer::Source(_) => {
                assert!(count == 1, "a row of the table is written by one source");
                assert!(is_named, "a row of the table is written by the source that it names");
            }
            Writer::Rotors | Writer::Propellant => assert!(count == 0, "the motion writes this row"),
        }
        k += 1;
    }
}

const fn equal(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut k = 0;
    while k < a.len() && k < b.len() && a[k] == b[k] {
        k += 1;
    }
    k == a.len() && k == b.len()
}
