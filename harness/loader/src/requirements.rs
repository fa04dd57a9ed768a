//! System requirements of a shared library: machine, libraries, functions and versions, read from ELF or PE without loading it.

use std::path::{Path, PathBuf};

use goblin::{Object, elf::Elf, pe::PE};

use crate::{Error, Fmu};

/// A library is read into memory up to this size.
const MAX_BYTES: u64 = 1 << 30;

/// Folders of `binaries/` and their libraries that are read of one FMU.
const MAX_LIBRARIES: usize = 64;

/// What a shared library asks of the system that loads it.
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
}

impl Requirements {
    /// Reads the library in the file `path`.
    ///
    /// # Errors
    ///
    /// The file cannot be read, is larger than 1 GiB, or is neither ELF nor PE.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let bytes = files::read_at_most(path, MAX_BYTES)
            .map_err(|source| Error::File { path: path.to_owned(), source })?;
        let refused = |what: String| Error::NotReadable { path: path.to_owned(), what };
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
        Ok(found)
    }

    fn of_elf(elf: &Elf<'_>) -> Self {
        let needed = elf.verneed.iter().flat_map(|section| section.iter());
        let versions = needed.flat_map(|file| {
            file.iter().filter_map(|version| elf.dynstrtab.get_at(version.vna_name)).collect::<Vec<_>>()
        });
        let glibc = versions.filter_map(|version| version.strip_prefix("GLIBC_")).max_by_key(|it| numbers(it));
        let imported = elf.dynsyms.iter().filter(|symbol| symbol.is_import() && symbol.st_name != 0);
        Self {
            path: PathBuf::new(),
            format: format!("ELF {}", machine(goblin::elf::header::machine_to_str(elf.header.e_machine))),
            libraries: elf.libraries.iter().map(|&name| name.to_owned()).collect(),
            glibc: glibc.map(ToOwned::to_owned),
            imports: imported
                .filter_map(|symbol| elf.dynstrtab.get_at(symbol.st_name))
                .map(ToOwned::to_owned)
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
        }
    }
}

impl std::fmt::Display for Requirements {
    /// `ELF x86-64, glibc 2.17 or later; needs libc.so.6, libm.so.6`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.format)?;
        if let Some(version) = &self.glibc {
            write!(f, ", glibc {version} or later")?;
        }
        match self.libraries.is_empty() {
            true => f.write_str("; needs no library"),
            false => write!(f, "; needs {}", self.libraries.join(", ")),
        }
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
