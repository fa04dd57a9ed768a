//! Enumerations that users choose from: number, name and meaning of each item stand at its variant.

/// An item of an enumeration.
#[derive(Clone, Copy, Debug)]
pub struct Item<T> {
    /// The variant.
    pub variant: T,
    /// Its number.
    pub value: i32,
    /// Its name: the variant's with a small first letter, or what serde renames it to.
    pub name: &'static str,
    /// Meaning of the item.
    pub meaning: &'static str,
}

/// An enum whose variants are items that users choose from.
pub trait Enumerated: Copy + 'static {
    /// The items in the order of the variants.
    const ITEMS: &'static [Item<Self>];

    /// The number of the item.
    fn value(self) -> i32;

    /// The item of this number.
    fn from_value(value: i32) -> Option<Self> {
        Self::ITEMS.iter().find(|item| item.value == value).map(|item| item.variant)
    }

    /// The name of the item.
    fn name(self) -> &'static str {
        Self::ITEMS.iter().find(|item| item.value == self.value()).map_or("", |item| item.name)
    }
}

/// Defines an enum and its items; a variant's number stands before it, its doc comment is the item's meaning.
macro_rules! enumeration {
    ($(#[$attribute:meta])* $visibility:vis enum $name:ident {
        $($(#[$($of_item:tt)+])+ $value:literal => $variant:ident,)+
    }) => {
        $(#[$attribute])*
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        $visibility enum $name {
            $($(#[$($of_item)+])+ $variant,)+
        }

        impl $crate::enumeration::Enumerated for $name {
            const ITEMS: &'static [$crate::enumeration::Item<Self>] = &[$({
                use $crate::enumeration::{enumeration, small, text};
                const RENAMED: &str = concat!($(enumeration!(@name $($of_item)+)),+);
                const SMALL: [u8; stringify!($variant).len()] = small(stringify!($variant));
                $crate::enumeration::Item {
                    variant: Self::$variant,
                    value: $value,
                    name: if RENAMED.is_empty() { text(&SMALL) } else { RENAMED },
                    meaning: concat!($(enumeration!(@meaning $($of_item)+)),+).trim_ascii(),
                }
            }),+];

            fn value(self) -> i32 {
                match self {
                    $(Self::$variant => $value,)+
                }
            }
        }
    };
    (@meaning doc = $meaning:literal) => { $meaning };
    (@name serde(rename = $name:literal)) => { $name };
    (@$of:ident $($other:tt)+) => { "" };
}
pub(crate) use enumeration;

/// Defines enums by [`enumeration`] that files name as well: by the items' names, the same in a schema.
macro_rules! file_enumerations {
    ($($(#[$attribute:meta])* $visibility:vis enum $name:ident $items:tt)+) => {$(
        $crate::enumeration::enumeration! {
            $(#[$attribute])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
            #[serde(rename_all = "camelCase")]
            $visibility enum $name $items
        }
    )+};
}
pub(crate) use file_enumerations;

/// The bytes of a name with a small first letter.
pub(crate) const fn small<const N: usize>(name: &str) -> [u8; N] {
    let mut bytes = [0; N];
    let mut at = 0;
    while at < N {
        bytes[at] = if at == 0 { name.as_bytes()[at].to_ascii_lowercase() } else { name.as_bytes()[at] };
        at += 1;
    }
    bytes
}

/// The text of bytes that are one.
pub(crate) const fn text(bytes: &'static [u8]) -> &'static str {
    match core::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(_) => "",
    }
}
