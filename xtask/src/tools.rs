//! Tools for other platforms, with tested versions and how to install them; those from PyPI are in `zig-requirements.txt`.

use std::path::PathBuf;

use crate::shell::{self, Outcome, available, command};

/// A program, its tested version as in the first line of `--version`, and how to install it.
pub(crate) struct Tool {
    pub program: &'static str,
    tested: &'static str,
    install: &'static str,
}

/// Compiles C for Windows and links Rust for it.
pub(crate) const MINGW: Tool = Tool {
    program: "x86_64-w64-mingw32-gcc",
    tested: "12-win32",
    install: "apt-get install gcc-mingw-w64-x86-64",
};
/// Runs programs for Windows.
pub(crate) const WINE: Tool =
    Tool { program: "wine", tested: "wine-8.0", install: "apt-get install wine wine64" };
/// Compiles C for Arm; its C library is what programs under qemu load.
pub(crate) const ARM_GCC: Tool = Tool {
    program: "aarch64-linux-gnu-gcc",
    tested: "12.2.0",
    install: "apt-get install gcc-aarch64-linux-gnu libc6-dev-arm64-cross",
};
/// Runs programs for Arm.
pub(crate) const QEMU: Tool = Tool {
    program: "qemu-aarch64",
    tested: "version 7.2",
    install: "apt-get install qemu-user qemu-user-binfmt",
};

/// The compiler; standard libraries of other platforms are of its version, whichever it is.
const RUSTC: Tool = Tool { program: "rustc", tested: "1.95.0", install: "rustup toolchain install 1.95" };

/// Checks that tools are available; another version than the tested one is accepted with a note.
pub(crate) fn need(tools: &[&Tool]) -> Outcome {
    let missing: Vec<String> = tools
        .iter()
        .filter(|tool| !available(tool.program))
        .map(|tool| format!("{} is missing: {}", tool.program, tool.install))
        .collect();
    if !missing.is_empty() {
        return Err(missing.join("\n"));
    }
    for tool in tools {
        let version = shell::output(command(tool.program).arg("--version"))?;
        let version = version.lines().next().unwrap_or_default();
        if !version.contains(tool.tested) {
            eprintln!("note: {}: found {version:?}, tested with {}", tool.program, tool.tested);
        }
    }
    Ok(())
}

/// Checks that the standard library for a target is installed.
pub(crate) fn need_library_for(target: &str) -> Outcome {
    need(&[&RUSTC])?;
    let folder = shell::output(command("rustc").args(["--print", "target-libdir", "--target", target]))?;
    match PathBuf::from(folder.trim()).is_dir() {
        true => Ok(()),
        false => Err(format!("the standard library for {target} is missing: rustup target add {target}")),
    }
}

/// Checks that the sources of the standard library are installed.
pub(crate) fn need_library_sources() -> Outcome {
    need(&[&RUSTC])?;
    let sysroot = shell::output(command("rustc").args(["--print", "sysroot"]))?;
    let lock = PathBuf::from(sysroot.trim()).join("lib/rustlib/src/rust/library/Cargo.lock");
    match lock.is_file() {
        true => Ok(()),
        false => {
            Err("the sources of the standard library are missing: rustup component add rust-src".to_owned())
        }
    }
}

/// Checks that programs for Arm can be executed, also by one another.
pub(crate) fn need_arm_programs() -> Outcome {
    let registered = PathBuf::from("/proc/sys/fs/binfmt_misc/qemu-aarch64");
    match registered.exists() {
        true => Ok(()),
        false => Err(format!(
            "programs for Arm cannot start one another here ({} is missing): apt-get install qemu-user-binfmt \
             binfmt-support",
            registered.display()
        )),
    }
}
