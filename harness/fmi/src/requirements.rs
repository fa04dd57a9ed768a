//! System requirements of a shared library: machine, libraries, functions and versions, read from ELF or PE without
//! loading it.

use std::path::{Path, PathBuf};

use goblin::{
    Object,
    elf::{Elf, Sym},
    pe::PE,
};

use crate::{
    Error, Fmu,
    fmu::{folders_of_format, is_platform_folder},
};

/// A library is read into memory up to this size.
const MAX_BYTES: u64 = 1 << 30;

/// Folders of `binaries/` and their libraries that are read of one FMU.
const MAX_LIBRARIES: usize = 64;

/// Elementary functions of the C library. IEEE 754 does not fix their rounding: with them, results hang on the system.
const ELEMENTARY: [&str; 25] = [
    "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "cos", "cosh", "exp", "exp10",
    "exp2", "expm1", "hypot", "log", "log10", "log1p", "log2", "pow", "sin", "sincos", "sinh", "tan", "tanh",
];

/// Requirements of a shared library on the system that loads it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Requirements {
    /// Path in the FMU, such as `binaries/linux64/MomentumPlant.so`.
    pub path: PathBuf,
    /// Kind of file and machine, such as `ELF x86-64`.
    pub format: String,
    /// Shared libraries that it needs, by their names.
    pub libraries: Vec<String>,
    /// Highest version of glibc among the versions of symbols that it needs, as in `2.17`.
    pub glibc: Option<String>,
    /// Functions and data that it takes from other libraries.
    pub imports: Vec<String>,
    /// Symbols that it cannot do without and whose library it does not name by a version; of ELF only.
    pub unversioned: Vec<String>,
}

impl Requirements {
    /// Reads the library in the file `path`.
    ///
    /// # Errors
    ///
    /// The file cannot be read, is larger than 1 GiB, or is neither ELF nor PE.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let bytes = files::read_at_most(path, MAX_BYTES).map_err(Error::file(path))?;
        let refused = |what: String| Error::Unusable { path: path.to_owned(), what };
        let mut found = match Object::parse(&bytes) {
            Ok(Object::Elf(elf)) => Self::of_elf(&elf),
            Ok(Object::PE(pe)) => Self::of_pe(&pe),
            Ok(_) => return Err(refused("found another format; ELF and PE can be read".to_owned())),
            Err(error) => return Err(refused(format!("it is no complete ELF or PE file: {error}"))),
        };
        found.path = path.to_owned();
        found.libraries.sort();
        found.libraries.dedup();
        found.imports.sort();
        found.imports.dedup();
        found.unversioned.sort();
        Ok(found)
    }

    /// The imports that are elementary functions, of either precision: results hang on the system that has them.
    pub fn elementary_functions(&self) -> impl Iterator<Item = &str> {
        let is_elementary = |name: &str| ELEMENTARY.contains(&name);
        let imports = self.imports.iter().map(String::as_str);
        imports.filter(move |name| is_elementary(name) || name.strip_suffix('f').is_some_and(is_elementary))
    }

    /// Folders under `binaries/` that may hold such a library, best first; none where FMI names no such platform.
    #[must_use]
    pub fn platform_folders(&self) -> &'static [&'static str] {
        folders_of_format(&self.format)
    }

    /// Ending of such a library's name.
    #[must_use]
    pub fn suffix(&self) -> &'static str {
        if self.format.starts_with("PE ") { ".dll" } else { ".so" }
    }

    /// Whether importers that this library is for look for it where it stands in the FMU; of a platform that FMI 2.0 does not
    /// name, whether no other platform's importers do.
    #[must_use]
    pub fn is_in_platform_folder(&self) -> bool {
        let folder = self.path.parent().and_then(Path::file_name).and_then(|name| name.to_str());
        let own = self.platform_folders();
        let belongs = folder.is_some_and(|folder| match own.is_empty() {
            true => !is_platform_folder(folder),
            false => own.contains(&folder),
        });
        belongs && self.path.to_string_lossy().ends_with(self.suffix())
    }

    fn of_elf(elf: &Elf<'_>) -> Self {
        let needed = elf.verneed.iter().flat_map(|section| section.iter());
        let versions = needed.flat_map(|file| {
            file.iter().filter_map(|version| elf.dynstrtab.get_at(version.vna_name)).collect::<Vec<_>>()
        });
        let glibc =
            versions.filter_map(|version| version.strip_prefix("GLIBC_")).max_by_key(|it| numbers(it));
        let imported = || {
            elf.dynsyms.iter().enumerate().filter(|(_, symbol)| symbol.st_shndx == 0 && symbol.st_name != 0)
        };
        let name = |symbol: Sym| elf.dynstrtab.get_at(symbol.st_name).map(ToOwned::to_owned);
        // Without a version of its own: 0 is local, 1 global.
        let is_versioned = |index: usize| {
            elf.versym
                .as_ref()
                .and_then(|table| table.get_at(index))
                .is_some_and(|version| version.version() > 1)
        };
        let is_weak = |symbol: &Sym| symbol.st_bind() == goblin::elf::sym::STB_WEAK;
        Self {
            path: PathBuf::new(),
            format: format!("ELF {}", machine(goblin::elf::header::machine_to_str(elf.header.e_machine))),
            libraries: elf.libraries.iter().map(|&name| name.to_owned()).collect(),
            glibc: glibc.map(ToOwned::to_owned),
            imports: imported().filter_map(|(_, symbol)| name(symbol)).collect(),
            unversioned: imported()
                .filter(|(index, symbol)| !is_versioned(*index) && !is_weak(symbol))
                .filter_map(|(_, symbol)| name(symbol))
                .collect(),
        }
    }

    fn of_pe(pe: &PE<'_>) -> Self {
        let machine = match pe.header.coff_header.machine {
            goblin::pe::header::COFF_MACHINE_X86_64 => "x86-64",
            goblin::pe::header::COFF_MACHINE_X86 => "x86",
            goblin::pe::header::COFF_MACHINE_ARM64 => "AArch64",
            _ => "of another machine",
        };
        Self {
            path: PathBuf::new(),
            format: format!("PE {machine}"),
            libraries: pe.libraries.iter().map(|&name| name.to_owned()).collect(),
            glibc: None,
            imports: pe.imports.iter().map(|import| import.name.to_string()).collect(),
            unversioned: Vec::new(),
        }
    }
}

impl std::fmt::Display for Requirements {
    /// `ELF x86-64, glibc 2.17 or later; needs libc.so.6, libm.so.6; its results hang on the system's cos, sin`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.format)?;
        if let Some(version) = &self.glibc {
            write!(f, ", glibc {version} or later")?;
        }
        match self.libraries.is_empty() {
            true => f.write_str("; needs no library"),
            false => write!(f, "; needs {}", self.libraries.join(", ")),
        }?;
        let elementary: Vec<&str> = self.elementary_functions().collect();
        if !elementary.is_empty() {
            write!(f, "; its results hang on the system's {}", elementary.join(", "))?;
        }
        if !self.unversioned.is_empty() {
            write!(f, "; of any library or the importer: {}", self.unversioned.join(", "))?;
        }
        Ok(())
    }
}

impl Fmu {
    /// The requirements of each library in `binaries/`, in the order of their paths, or why one cannot be read.
    #[must_use]
    pub fn requirements(&self) -> Vec<(PathBuf, Result<Requirements, Error>)> {
        let binaries = self.folder().join("binaries");
        let children = |folder: &Path| {
            let entries = std::fs::read_dir(folder).map(|entries| entries.flatten()).into_iter().flatten();
            entries.map(|entry| entry.path()).take(MAX_LIBRARIES).collect::<Vec<_>>()
        };
        let is_library =
            |path: &PathBuf| path.extension().is_some_and(|ending| ending == "so" || ending == "dll");
        let mut paths: Vec<PathBuf> = children(&binaries)
            .iter()
            .flat_map(|platform| children(platform))
            .filter(|path| is_library(path) && path.is_file())
            .collect();
        paths.sort();
        paths.truncate(MAX_LIBRARIES);
        let within = |path: &Path| path.strip_prefix(self.folder()).unwrap_or(path).to_owned();
        let read = |path: PathBuf| {
            let read = Requirements::read(&path).map(|it| Requirements { path: within(&path), ..it });
            (within(&path), read)
        };
        paths.into_iter().map(read).collect()
    }
}

/// `2.17` as numbers, which sort as versions do.
fn numbers(version: &str) -> Vec<u32> {
    version.split('.').map_while(|part| part.parse().ok()).collect()
}

/// The machine by the name that people use.
fn machine(name: &str) -> &str {
    match name {
        "X86_64" => "x86-64",
        "386" => "x86",
        "AARCH64" => "AArch64",
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    #[test]
    fn this_program_asks_for_the_c_library() {
        let found = Requirements::read(&std::env::current_exe().unwrap()).unwrap();
        assert!(found.format.starts_with("ELF "), "{found}");
        assert!(found.libraries.iter().any(|name| name == "libc.so.6"), "{found}");
        assert!(found.imports.iter().any(|name| name == "write"), "{found}");
        // Every program for x86-64 asks for 2.2.5 at least, and none of today for a hundred.
        assert!((2..3).contains(&numbers(&found.glibc.unwrap())[0]));
    }

    #[test]
    fn versions_sort_by_their_numbers() {
        assert!(numbers("2.2.5") < numbers("2.17") && numbers("2.17") < numbers("2.34"));
    }

    #[test]
    fn functions_whose_rounding_hangs_on_the_system_are_reported() {
        let imports = ["cosf", "floor", "malloc", "sincos", "sinks"].map(str::to_owned).to_vec();
        let requirements =
            Requirements { format: "ELF x86-64".to_owned(), imports, ..Requirements::default() };
        assert_eq!(requirements.elementary_functions().collect::<Vec<_>>(), ["cosf", "sincos"]);
        let expected = "ELF x86-64; needs no library; its results hang on the system's cosf, sincos";
        assert_eq!(requirements.to_string(), expected);
    }

    #[test]
    fn a_header_of_windows_tells_the_machine() {
        let mut bytes = vec![0; 0x400];
        bytes[..2].copy_from_slice(b"MZ");
        bytes[0x3c] = 0x80;
        bytes[0x80..0x84].copy_from_slice(b"PE\0\0");
        bytes[0x84..0x86].copy_from_slice(&0x8664_u16.to_le_bytes());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("library.dll");
        std::fs::write(&path, bytes).unwrap();
        assert_eq!(Requirements::read(&path).unwrap().to_string(), "PE x86-64; needs no library");
    }

    #[test]
    fn a_library_in_the_folder_of_another_platform_is_reported() {
        let requirements = |format: &str, path: &str| Requirements {
            format: format.to_owned(),
            path: path.into(),
            ..Requirements::default()
        };
        for (format, path) in [
            ("ELF x86-64", "binaries/linux64/X.so"),
            ("ELF AArch64", "binaries/aarch64-linux/X.so"),
            // FMPy on Arm.
            ("ELF AArch64", "binaries/linux64/X.so"),
            ("PE x86-64", "binaries/win64/X.dll"),
            ("ELF RISCV", "binaries/riscv64-linux/X.so"),
        ] {
            assert!(requirements(format, path).is_in_platform_folder(), "{format} {path}");
        }
        for (format, path) in [
            ("ELF x86-64", "binaries/win64/X.dll"),
            ("PE x86-64", "binaries/win64/X.so"),
            ("PE x86", "binaries/win64/X.dll"),
            ("PE of another machine", "binaries/win64/X.dll"),
        ] {
            assert!(!requirements(format, path).is_in_platform_folder(), "{format} {path}");
        }
    }

    #[test]
    fn other_files_are_refused_with_their_path() {
        let folder = tempfile::tempdir().unwrap();
        for content in ["no library", "\u{7f}ELF cut off"] {
            let path = folder.path().join("library.so");
            std::fs::write(&path, content).unwrap();
            let text = Requirements::read(&path).unwrap_err().to_string();
            assert!(text.contains("library.so") && text.contains("ELF"), "{text}");
        }
    }
}
