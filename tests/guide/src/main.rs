//! `guide [FOLDER]`: builds the guide into the folder, `target/guide` otherwise, and says where its first page is.

use std::path::PathBuf;
use std::process::ExitCode;

fn main() -> ExitCode {
    let project = heliotorque_guide::project();
    let output = std::env::args().nth(1).map_or_else(|| project.join("target").join("guide"), PathBuf::from);
    match heliotorque_guide::build(&project.join("docs"), &output) {
        Ok(page) => {
            println!("{}", page.display());
            ExitCode::SUCCESS
        }
        Err(problem) => {
            eprintln!("guide: {problem}");
            ExitCode::FAILURE
        }
    }
}
