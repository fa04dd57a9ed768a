//! Elements of the XML as tables: a field, its attribute and whether that is required, one row for reader and writer.
//!
//! `field: Type = required "name"` must stand in the XML, `optional` is an [`Option`], and `or(default)` is left out where it has
//! that value. Rows are in the order of the XML schema. What follows a `;` is no attribute.

#[cfg(feature = "reader")]
mod error;
#[cfg(feature = "reader")]
mod fields;

use crate::writer::Writer;

#[cfg(feature = "reader")]
pub use error::ReadError;
#[cfg(feature = "reader")]
pub(crate) use fields::Fields;

/// An element with attributes.
pub(crate) trait Element: Sized {
    /// Takes the attributes from those of a start tag.
    #[cfg(feature = "reader")]
    fn read(fields: &mut Fields) -> Result<Self, ReadError>;
    /// Writes the attributes.
    fn write(&self, out: &mut Writer);
}

#[cfg(feature = "reader")]
macro_rules! read_attribute {
    ($fields:ident, required $name:literal) => {
        $fields.required($name)?
    };
    ($fields:ident, optional $name:literal) => {
        $fields.optional($name)?
    };
    ($fields:ident, or($default:expr) $name:literal) => {
        $fields.optional($name)?.unwrap_or($default)
    };
    ($fields:ident, nested) => {
        $crate::element::Element::read($fields)?
    };
    ($fields:ident, child) => {
        Default::default()
    };
}
#[cfg(feature = "reader")]
pub(crate) use read_attribute;

macro_rules! write_attribute {
    ($out:ident, $value:expr, required $name:literal) => {
        $out.attribute($name, $value)
    };
    ($out:ident, $value:expr, optional $name:literal) => {
        $out.optional($name, $value)
    };
    ($out:ident, $value:expr, or($default:expr) $name:literal) => {
        if *$value != $default {
            $out.attribute($name, $value);
        }
    };
    ($out:ident, $value:expr, nested) => {
        $crate::element::Element::write($value, $out)
    };
    ($out:ident, $value:expr, child) => {
        let _ = $value;
    };
}
pub(crate) use write_attribute;

/// Declares the structure of an element.
macro_rules! element {
    (
        $(#[$meta:meta])*
        pub struct $type:ident {
            $(
                $(#[$doc:meta])*
                $field:ident: $value:ty = $presence:ident $(($default:expr))? $name:literal,
            )*
            $(; $($(#[$child_doc:meta])* $child:ident: $child_type:ty,)+)?
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs, reason = "most fields are the standard's own names")]
        pub struct $type {
            $($(#[$doc])* pub $field: $value,)*
            $($($(#[$child_doc])* pub $child: $child_type,)+)?
        }

        impl $crate::element::Element for $type {
            #[cfg(feature = "reader")]
            fn read(fields: &mut $crate::element::Fields) -> Result<Self, $crate::element::ReadError> {
                Ok(Self {
                    $($field: $crate::element::read_attribute!(fields, $presence $(($default))? $name),)*
                    $($($child: Default::default(),)+)?
                })
            }

            fn write(&self, out: &mut $crate::writer::Writer) {
                $($crate::element::write_attribute!(out, &self.$field, $presence $(($default))? $name);)*
            }
        }
    };
}
pub(crate) use element;

/// Declares an enumeration of elements, named as its variants; a `child` is no attribute.
macro_rules! elements {
    (
        $(#[$meta:meta])*
        pub enum $type:ident {
            $(
                $(#[$variant_doc:meta])*
                $variant:ident $({
                    $($(#[$doc:meta])* $field:ident: $value:ty = $presence:ident $($name:literal)?,)*
                })?
            )+
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs, reason = "most fields are the standard's own names")]
        pub enum $type {
            $($(#[$variant_doc])* $variant $({ $($(#[$doc])* $field: $value,)* })?,)+
        }

        impl $type {
            /// The element's name.
            pub const fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => stringify!($variant),)+
                }
            }

            /// The element of this name from its attributes; `None` if there is none of this name.
            #[cfg(feature = "reader")]
            pub(crate) fn read(
                name: &str,
                fields: &mut $crate::element::Fields,
            ) -> Result<Option<Self>, $crate::element::ReadError> {
                Ok(Some(match name {
                    $(stringify!($variant) => Self::$variant $({
                        $($field: $crate::element::read_attribute!(fields, $presence $($name)?),)*
                    })?,)+
                    _ => return Ok(None),
                }))
            }

            pub(crate) fn write(&self, out: &mut $crate::writer::Writer) {
                match self {
                    $(Self::$variant $({ $($field),* })? => {
                        $($($crate::element::write_attribute!(out, $field, $presence $($name)?);)*)?
                    })+
                }
            }
        }
    };
}
pub(crate) use elements;
