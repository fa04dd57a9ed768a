//! Any bytes are a model description or refused by line; what is read and lawful is read again from what is written.
#![no_main]

use libfuzzer_sys::fuzz_target;
use model_description::{Severity, parse, to_xml};

fuzz_target!(|bytes: &[u8]| {
    match parse(bytes) {
        Err(error) => assert!(error.line > 0 && !error.message.is_empty(), "{error:?}"),
        Ok(parsed) => {
            let findings = parsed.findings();
            let _ = findings.iter().map(ToString::to_string).collect::<Vec<_>>();
            if findings.iter().all(|it| it.severity() != Severity::Error) {
                let xml = to_xml(&parsed.description);
                let again = parse(xml.as_bytes()).unwrap_or_else(|error| panic!("{error:?} in {xml}"));
                assert_eq!(again.description, parsed.description, "{xml}");
            }
        }
    }
});
