//! Prints what the reader and the validator find in each `modelDescription.xml` given: `file: finding`.

fn main() -> std::process::ExitCode {
    let mut clean = true;
    for file in std::env::args().skip(1) {
        let findings = match std::fs::read(&file) {
            Ok(bytes) => match model_description::parse(&bytes) {
                Ok(parsed) => parsed.findings(),
                Err(error) => vec![error.into()],
            },
            Err(error) => {
                eprintln!("{file}: cannot be read: {error}");
                clean = false;
                continue;
            }
        };
        clean &= findings.is_empty();
        for finding in findings {
            println!("{file}: {finding}");
        }
    }
    if clean { std::process::ExitCode::SUCCESS } else { std::process::ExitCode::FAILURE }
}
