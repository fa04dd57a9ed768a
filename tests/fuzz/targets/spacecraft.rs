//! Any text is a spacecraft, spinner or timeline, or refused with what is wrong; what is accepted describes a lawful FMU.
#![no_main]

use std::sync::OnceLock;

use heliotorque_fuzz::library;
use libfuzzer_sys::fuzz_target;
use model_description::{Severity, validate};
use physics::guidance::timeline::Timeline;
use physics::spacecraft::{MESSENGER_TOML, Spacecraft};
use physics::spin::spinner::Spinner;
use physics::toml::FileError;

/// Whether the file was read; the reason of a refusal is not empty.
fn read<T>(outcome: Result<T, FileError>) -> bool {
    if let Err(error) = &outcome {
        assert!(error.to_string().starts_with("any.toml"), "{error}");
    }
    outcome.is_ok()
}

/// A timeline is read for this spacecraft.
fn messenger() -> &'static Spacecraft {
    static MESSENGER: OnceLock<Spacecraft> = OnceLock::new();
    MESSENGER.get_or_init(|| Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap())
}

fuzz_target!(|text: &str| {
    read(Timeline::from_toml("any.toml", text, messenger()));
    let models = [
        ("MomentumPlant", read(Spacecraft::from_toml("any.toml", text))),
        ("SpinPlant", read(Spinner::parse("any.toml", text))),
    ];
    for (model, accepted) in models {
        let described = library(model).find(model).map(|entry| entry.describe(None, Some(text)));
        let Some(Ok(description)) = described else { continue };
        assert!(accepted, "{model}: described what its reader refuses");
        let wrong: Vec<_> =
            validate(&description).into_iter().filter(|it| it.severity() == Severity::Error).collect();
        assert!(wrong.is_empty(), "{model}: {wrong:?}");
    }
});
