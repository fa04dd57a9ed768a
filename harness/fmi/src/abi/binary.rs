//! A loaded shared library with the functions of FMI 2.0 bound to their types.
//!
//! The library is never unloaded: Rust and C++ libraries leave thread-local destructors behind that would jump into
//! unmapped memory.

use std::{
    ffi::{c_char, c_void},
    path::Path,
};

use model_description::functions::types;

use super::text::text;
use crate::{Error, call_record};

#[cfg(unix)]
use libloading::os::unix::Library;
#[cfg(windows)]
use libloading::os::windows::Library;

/// Loads a library with its symbols to itself.
///
/// # Safety
/// The library's initialisers may be run.
#[cfg(unix)]
unsafe fn open(path: &Path) -> Result<Library, libloading::Error> {
    use libloading::os::unix::{RTLD_LOCAL, RTLD_NOW};
    // SAFETY: the caller's promise.
    unsafe { Library::open(Some(path), RTLD_NOW | RTLD_LOCAL) }
}

/// Loads a library and those that it needs from its own folder first, however long its path is.
///
/// # Safety
/// The library's initialisers may be run.
#[cfg(windows)]
unsafe fn open(path: &Path) -> Result<Library, libloading::Error> {
    use libloading::os::windows::LOAD_WITH_ALTERED_SEARCH_PATH;
    // LoadLibraryEx has MAX_PATH (260), but for paths as `canonicalize` gives them: `\\?\C:\...`.
    const MAX_PATH: usize = 260;
    let long = (path.as_os_str().len() >= MAX_PATH).then(|| std::fs::canonicalize(path).ok()).flatten();
    // SAFETY: the caller's promise.
    unsafe { Library::load_with_flags(long.as_deref().unwrap_or(path), LOAD_WITH_ALTERED_SEARCH_PATH) }
}

macro_rules! bind {
    ($($name:ident $symbol:ident $parameters:tt -> $result:ty: $access:expr;)*) => {
        /// Every function of an FMI 2.0 co-simulation FMU, `None` where the library lacks it.
        #[allow(non_snake_case, reason = "the standard's own names")]
        pub(super) struct Functions {
            $(pub(super) $symbol: Option<types::$symbol>,)*
        }

        impl Functions {
            /// # Safety
            /// The library's symbols of these names must have these types.
            unsafe fn bind(library: &Library) -> Self {
                // SAFETY: the caller's promise, one symbol at a time.
                unsafe {
                    Self { $($symbol: library
                        .get(concat!(stringify!($symbol), "\0").as_bytes())
                        .map(|symbol| *symbol)
                        .ok(),)* }
                }
            }

            fn missing(&self) -> Vec<&'static str> {
                let mut missing = Vec::new();
                $(if self.$symbol.is_none() { missing.push(stringify!($symbol)); })*
                missing
            }
        }
    };
}

model_description::functions!(bind);

macro_rules! number {
    ($($name:ident $symbol:ident $parameters:tt -> $result:ty: $access:expr;)*) => {
        /// The number of every function in the record of calls.
        #[allow(non_upper_case_globals, dead_code, reason = "the standard's own names, as `Functions` has them")]
        pub(super) mod numbers {
            use crate::call_record::number;
            use model_description::call_table::Function;

            $(pub(in crate::abi) const $symbol: u64 = number(Function::$name);)*
        }
    };
}

model_description::functions!(number);

/// A loaded shared library; it stays loaded for the life of the process.
pub struct Binary {
    pub(super) functions: Functions,
    pub(super) library: &'static Library,
}

impl std::fmt::Debug for Binary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Binary").field("missing", &self.missing()).finish_non_exhaustive()
    }
}

impl Binary {
    /// Loads the library at `path` with its symbols to itself: every FMU names its functions alike.
    pub fn load(path: &Path) -> Result<Self, Error> {
        let _under_way = call_record::enter(call_record::LOADING);
        // SAFETY: loading runs the library's initialisers; an FMU is code its user chose to run.
        let opened = unsafe { open(path) };
        let library = opened.map_err(|error| {
            let what = format!("the shared library does not load: {}", Error::chain(&error));
            Error::Unusable { path: path.to_owned(), what }
        })?;
        let library: &'static Library = Box::leak(Box::new(library));
        // SAFETY: the names are the standard's, so the types are the standard's.
        let functions = unsafe { Functions::bind(library) };
        Ok(Self { functions, library })
    }

    /// Functions of the standard that the library does not export.
    pub fn missing(&self) -> Vec<&'static str> {
        self.functions.missing()
    }

    /// Whether the library exports `symbol`.
    pub fn exports(&self, symbol: &str) -> bool {
        // SAFETY: the address is only compared with nothing.
        unsafe { self.library.get::<*const c_void>(symbol.as_bytes()).is_ok() }
    }

    /// `fmi2GetVersion` and `fmi2GetTypesPlatform`; `None` where missing or NULL.
    pub fn versions(&self) -> (Option<String>, Option<String>) {
        let read = |function: Option<unsafe extern "C" fn() -> *const c_char>| {
            // SAFETY: the function takes nothing and returns a text that is valid as long as the library.
            function.and_then(|function| unsafe { text(function()) })
        };
        (read(self.functions.fmi2GetVersion), read(self.functions.fmi2GetTypesPlatform))
    }
}
