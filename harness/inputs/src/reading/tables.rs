//! Tables of files as structs, by the macro of the physics crate: reader, schema and values in SI units of one declaration.

use std::path::Path;

use physics::toml::Place;

/// Value of a key, which is judged at its place.
pub(crate) trait Checked {
    /// Reports what is wrong with the value; completes it by its place and the folder of its file.
    fn check(&mut self, _at: &Place<'_>, _folder: &Path) {}
}

impl<T: Checked> Checked for Option<T> {
    fn check(&mut self, at: &Place<'_>, folder: &Path) {
        self.iter_mut().for_each(|it| it.check(at, folder));
    }
}

impl<T: Checked> Checked for Vec<T> {
    fn check(&mut self, at: &Place<'_>, folder: &Path) {
        self.iter_mut().enumerate().for_each(|(index, it)| it.check(&at.item(index), folder));
    }
}

impl Checked for bool {}
impl Checked for String {}

/// Declares tables as [`physics::tables`] does, whose values are judged too: a default is one of the key's type.
macro_rules! tables {
    ($($tables:tt)+) => {
        physics::tables! { $($tables)+ }
        $crate::reading::tables::checks! { $($tables)+ }
    };
}

macro_rules! checks {
    ($($(#[$about:meta])* struct $table:ident $(called $kind:literal)? makes $(#[$made_about:meta])* $seen:vis struct $made:ident $(or $default_value:ident)? {
        $($(#[$key_about:meta])* $key:ident $(as $name:ident)?: $type:ty $(= $default:expr)? $(=> $follows:expr)?,)+
    } $(rules { $($rule:tt)+ })?)+) => {$(
        impl $crate::reading::Checked for $table {
            fn check(&mut self, at: &physics::toml::Place<'_>, folder: &std::path::Path) {
                at.rules(<$table as physics::toml::Table>::RULES);
                $($(self.$key.get_or_insert_with(|| <$type>::from($default));)?)+
                $(self.$key.check(&at.key(stringify!($key).trim_start_matches("r#")), folder);)+
            }
        }
    )+};
}

/// Enumerations that are written as they are used.
macro_rules! words {
    ($($word:ty),+) => {$(
        impl $crate::reading::Checked for $word {}

        impl physics::toml::Written for $word {
            type Value = Self;

            fn value(&self) -> Self {
                *self
            }
        }
    )+};
}

pub(crate) use {checks, tables, words};
