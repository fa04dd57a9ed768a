//! Linker settings of the shared library.

use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    // Each package with this script has this file; cargo repeats a script whose file is missing.
    println!("cargo:rerun-if-changed=Cargo.toml");
    if env::var("CARGO_CFG_TARGET_OS")? == "linux" && env::var("CARGO_CFG_TARGET_ENV")? == "gnu" {
        // The standard library asks for libgcc_s by name: the linker finds this script of that name first, and so
        // the FMU brings its own unwinder.
        let folder = PathBuf::from(env::var("OUT_DIR")?);
        fs::write(folder.join("libgcc_s.so"), "INPUT(-lgcc_eh -lgcc)\n")?;
        println!("cargo:rustc-cdylib-link-arg=-L{}", folder.display());
    }
    Ok(())
}
