//! The tools that other platforms need: what was tried, what brings them. Those of Python stand in `zig-requirements.txt`.

use std::path::PathBuf;

use crate::shell::{self, Outcome, available, command};

/// A program, its version that everything was tried with as the first line of its `--version` has it, and what brings it.
pub(crate) struct Tool {
    pub program: &'static str,
    tried: &'static str,
    brought_by: &'static str,
}

/// Compiles C for Windows and links Rust for it.
pub(crate) const MINGW: Tool = Tool {
    program: "x86_64-w64-mingw32-gcc",
    tried: "12-win32",
    brought_by: "apt-get install gcc-mingw-w64-x86-64",
};
/// Runs programs for Windows.
pub(crate) const WINE: Tool =
    Tool { program: "wine", tried: "wine-8.0", brought_by: "apt-get install wine wine64" };
/// Compiles C for Arm; its C library is what programs under qemu load.
pub(crate) const ARM_GCC: Tool = Tool {
    program: "aarch64-linux-gnu-gcc",
    tried: "12.2.0",
    brought_by: "apt-get install gcc-aarch64-linux-gnu libc6-dev-arm64-cross",
};
/// Runs programs for Arm.
pub(crate) const QEMU: Tool = Tool {
    program: "qemu-aarch64",
    tried: "version 7.2",
    brought_by: "apt-get install qemu-user qemu-user-binfmt",
};

/// The compiler; standard libraries of other platforms are of its version, whichever it is.
const RUSTC: Tool = Tool { program: "rustc", tried: "1.95.0", brought_by: "rustup toolchain install 1.95" };

/// Expects tools; those that are missing are named together. Another version than was tried is taken, and said.
pub(crate) fn need(tools: &[&Tool]) -> Outcome {
    let missing: Vec<String> = tools
        .iter()
        .filter(|tool| !available(tool.program))
        .map(|tool| format!("{} is missing: {}", tool.program, tool.brought_by))
        .collect();
    if !missing.is_empty() {
        return Err(missing.join("\n"));
    }
    for tool in tools {
        let version = shell::output(command(tool.program).arg("--version"))?;
        let version = version.lines().next().unwrap_or_default();
        if !version.contains(tool.tried) {
            eprintln!("note: {}: found {version:?}, tried with {}", tool.program, tool.tried);
        }
    }
    Ok(())
}

/// Expects the compiler's standard library for a target.
pub(crate) fn need_library_for(target: &str) -> Outcome {
    need(&[&RUSTC])?;
    let folder = shell::output(command("rustc").args(["--print", "target-libdir", "--target", target]))?;
    match PathBuf::from(folder.trim()).is_dir() {
        true => Ok(()),
        false => Err(format!("the standard library for {target} is missing: rustup target add {target}")),
    }
}

/// Expects the sources of the compiler's standard library.
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

/// Expects programs for Arm to start as others do, also from one another.
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
