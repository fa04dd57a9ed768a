//! Finite bounds of the floats in a model's state: what a state is refused for, whatever its type.

use core::fmt::Display;

use serde::{Serialize, Serializer, ser};

use crate::model::Failure;

/// Greatest magnitude of a number in a saved state: far beyond any quantity, and its square is finite.
const GREATEST: f64 = 1e100;

/// Refuses a state with a float that no simulation can continue with. Allocates only to refuse.
///
/// # Errors
/// The field that is not finite or beyond 1e100 in magnitude, and its value.
pub fn check_finite<T: Serialize>(state: &T) -> Result<(), Failure> {
    state.serialize(Bounded).map_err(|found| {
        Failure::new(format!(
            "model state: {} holds {:?}, allowed are finite numbers within {GREATEST:e}",
            if found.field.is_empty() { "it" } else { found.field },
            found.value
        ))
    })
}

/// A float out of bounds, and the innermost named field that holds it.
#[derive(Debug, thiserror::Error)]
#[error("{field}: {value:?}")]
struct OutOfBounds {
    field: &'static str,
    value: f64,
}

impl OutOfBounds {
    fn within(self, field: &'static str) -> Self {
        if self.field.is_empty() { Self { field, ..self } } else { self }
    }
}

impl ser::Error for OutOfBounds {
    fn custom<T: Display>(_: T) -> Self {
        Self { field: "a value that cannot be encoded", value: f64::NAN }
    }
}

/// Walks through a value and writes nothing.
#[derive(Clone, Copy)]
struct Bounded;

type Walked = Result<(), OutOfBounds>;

macro_rules! pass {
    ($($method:ident($($argument:ty),*))*) => {
        $(fn $method(self, $(_: $argument),*) -> Walked { Ok(()) })*
    };
}

macro_rules! enter {
    ($($method:ident($($argument:ty),*))*) => {
        $(fn $method(self, $(_: $argument),*) -> Result<Self, OutOfBounds> { Ok(self) })*
    };
}

impl Serializer for Bounded {
    type Ok = ();
    type Error = OutOfBounds;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    pass! {
        serialize_bool(bool) serialize_i8(i8) serialize_i16(i16) serialize_i32(i32) serialize_i64(i64)
        serialize_i128(i128) serialize_u8(u8) serialize_u16(u16) serialize_u32(u32) serialize_u64(u64)
        serialize_u128(u128) serialize_char(char) serialize_str(&str) serialize_bytes(&[u8]) serialize_none()
        serialize_unit() serialize_unit_struct(&'static str)
        serialize_unit_variant(&'static str, u32, &'static str)
    }

    enter! {
        serialize_seq(Option<usize>)
        serialize_tuple(usize)
        serialize_tuple_struct(&'static str, usize)
        serialize_tuple_variant(&'static str, u32, &'static str, usize)
        serialize_map(Option<usize>)
        serialize_struct(&'static str, usize)
        serialize_struct_variant(&'static str, u32, &'static str, usize)
    }

    fn serialize_f32(self, value: f32) -> Walked {
        self.serialize_f64(value.into())
    }

    fn serialize_f64(self, value: f64) -> Walked {
        // Written so that NaN fails.
        if value.abs() <= GREATEST { Ok(()) } else { Err(OutOfBounds { field: "", value }) }
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Walked {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Walked {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        value: &T,
    ) -> Walked {
        value.serialize(self)
    }

    fn is_human_readable(&self) -> bool {
        false
    }
}

macro_rules! elements {
    ($($kind:ident $method:ident($($name:ident)?))*) => {
        $(impl ser::$kind for Bounded {
            type Ok = ();
            type Error = OutOfBounds;

            fn $method<T: Serialize + ?Sized>(&mut self, $($name: &'static str,)? value: &T) -> Walked {
                value.serialize(*self)$(.map_err(|found| found.within($name)))?
            }

            fn end(self) -> Walked {
                Ok(())
            }
        })*
    };
}

elements! {
    SerializeSeq serialize_element()
    SerializeTuple serialize_element()
    SerializeTupleStruct serialize_field()
    SerializeTupleVariant serialize_field()
    SerializeStruct serialize_field(name)
    SerializeStructVariant serialize_field(name)
}

impl ser::SerializeMap for Bounded {
    type Ok = ();
    type Error = OutOfBounds;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Walked {
        key.serialize(*self)
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Walked {
        value.serialize(*self)
    }

    fn end(self) -> Walked {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    //! A float out of bounds is found wherever serde can put one.
    use std::collections::BTreeMap;

    use super::*;

    #[derive(Serialize)]
    enum Shape {
        Unit,
        Newtype(f64),
        Tuple(f64, f32),
        Struct { depth: f64 },
    }

    #[derive(Serialize)]
    struct Everything {
        name: &'static str,
        plain: f64,
        single: f32,
        maybe: Option<f64>,
        list: Vec<(u8, f64)>,
        table: BTreeMap<u8, [f64; 2]>,
        shapes: [Shape; 4],
    }

    fn everything([plain, single, maybe, list, table, newtype, tuple, depth]: [f64; 8]) -> Everything {
        Everything {
            name: "probe",
            plain,
            single: single as f32,
            maybe: Some(maybe),
            list: vec![(1, list)],
            table: BTreeMap::from([(1, [0.0, table])]),
            shapes: [Shape::Unit, Shape::Newtype(newtype), Shape::Tuple(tuple, 1.0), Shape::Struct { depth }],
        }
    }

    #[test]
    fn each_float_that_is_not_finite_or_beyond_the_bound_is_refused_with_its_field() {
        let fields = ["plain", "single", "maybe", "list", "table", "shapes", "shapes", "depth"];
        assert_eq!(check_finite(&everything([-1e30; 8])), Ok(()));
        for (place, field) in fields.into_iter().enumerate() {
            for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.1e100, -f64::MAX] {
                let mut numbers = [1.0; 8];
                numbers[place] = wrong;
                let refused = check_finite(&everything(numbers)).unwrap_err().to_string();
                assert!(refused.contains(&format!("{field} holds")), "{place}: {refused}");
            }
        }
        assert_eq!(check_finite(&1e100), Ok(()));
    }
}
