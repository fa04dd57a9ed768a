//! From a TOML value to a type, continuing behind every mistake: an unknown key is passed over, and a value that is
//! missing or of the wrong type is stood in for, so that one reading finds them all.

use core::cell::RefCell;

use serde::de::value::{Error, MapDeserializer, SeqDeserializer};
use serde::de::{Deserializer, IntoDeserializer, Visitor};
use serde::forward_to_deserialize_any;
use toml::de::{DeTable, DeValue};

use super::directions;
use super::key_path::KeyPath;
use super::limits::{MOST_PROBLEMS, most_items};
use super::numbers::short;
use super::ranges::Range;
use super::spelling::{hint, nearest};

/// Most problems that are kept; the first by line are listed.
pub(super) const MOST_KEPT: usize = 10 * MOST_PROBLEMS;

/// Problems found while a document was read into a type.
#[derive(Default)]
pub(super) struct Findings {
    /// Place, what was found there and what is allowed.
    pub problems: Vec<(KeyPath, String, String)>,
    /// How many more were found than are kept.
    pub unlisted: usize,
    /// Keys whose value was not written or not usable, so that a placeholder stands in for it.
    pub stand_ins: Vec<KeyPath>,
}

/// A value, or the lack of one, at a place.
pub(super) struct Reader<'r> {
    value: Option<&'r DeValue<'r>>,
    /// Whether a lack is a problem of its own; inside of what is missing it is not.
    is_expected: bool,
    /// Range that a number must lie in.
    range: Option<&'static Range>,
    place: KeyPath,
    findings: &'r RefCell<Findings>,
    /// Most items of lists by key in this kind of file.
    own_limits: &'static [(&'static str, usize)],
}

impl<'r> Reader<'r> {
    /// Reads a whole file.
    pub(super) fn new(
        root: &'r DeValue<'r>,
        findings: &'r RefCell<Findings>,
        own_limits: &'static [(&'static str, usize)],
    ) -> Self {
        let (value, place) = (Some(root), KeyPath::root());
        Self { value, is_expected: true, range: None, place, findings, own_limits }
    }

    /// The value if it is what is allowed; otherwise the problem is noted and something else will stand in.
    fn given<T>(&self, take: impl FnOnce(&'r DeValue<'r>) -> Option<T>, allowed: &str) -> Option<T> {
        let taken = self.value.and_then(take);
        if taken.is_none() && self.is_expected {
            self.note(|| match self.value {
                Some(value) => {
                    let allowed = format!("{allowed}{}", remedy(value, allowed, &self.place.split().1));
                    (self.place.clone(), shown(value), allowed)
                }
                None => {
                    let (table, key) = self.place.split();
                    let allowed = format!("a value for `{key}`, which has no default");
                    (table, format!("no key `{key}`"), allowed)
                }
            });
            self.stand_in(self.place.clone());
        }
        taken
    }

    /// Notes a problem; beyond [`MOST_KEPT`] it is counted alone, for its words cost time and memory.
    fn note(&self, problem: impl FnOnce() -> (KeyPath, String, String)) {
        let mut findings = self.findings.borrow_mut();
        if findings.problems.len() < MOST_KEPT {
            findings.problems.push(problem());
        } else {
            findings.unlisted += 1;
        }
    }

    /// Whether a list or table of this length may be read; notes a longer one.
    fn may_have(&self, length: usize) -> bool {
        let most = most_items(&self.place, self.own_limits);
        if length <= most {
            return true;
        }
        self.note(|| (self.place.clone(), format!("{length} entries"), format!("at most {most}")));
        self.stand_in(self.place.clone());
        false
    }

    fn stand_in(&self, place: KeyPath) {
        self.findings.borrow_mut().stand_ins.push(place);
    }

    fn inside(&self, place: KeyPath, value: Option<&'r DeValue<'r>>, is_expected: bool) -> Self {
        let Self { findings, own_limits, .. } = *self;
        Self { value, is_expected, range: None, place, findings, own_limits }
    }

    /// The values of the known keys; unknown ones are noted, with the key that was meant standing in.
    fn fields(&self, keys: &'static [&'static str]) -> Vec<(&'r str, Self)> {
        let table = self.given(DeValue::as_table, "a table");
        let value = |key: &str| table.and_then(|table| get(table, key));
        let absent: Vec<&str> = keys.iter().copied().filter(|known| value(known).is_none()).collect();
        let mut misspelt = Vec::new();
        for key in table.into_iter().flat_map(DeTable::keys).map(|key| key.get_ref()) {
            if keys.contains(&key.as_ref()) {
                continue;
            }
            // A table of thousands of unknown keys has no slips of the pen.
            let meant = if misspelt.len() < keys.len() { nearest(key, &absent) } else { None };
            self.note(|| {
                let hint = meant.map(|_| hint(key, &absent)).unwrap_or_default();
                (self.place.key(key), format!("the unknown key `{key}`{hint}"), keys.join(", "))
            });
            if let Some(meant) = meant {
                self.stand_in(self.place.key(meant));
                misspelt.push(meant);
            }
        }
        let is_expected = |key| table.is_some() && !misspelt.contains(&key);
        let field =
            |key: &&'static str| (*key, self.inside(self.place.key(key), value(key), is_expected(*key)));
        keys.iter().map(field).collect()
    }

    /// Notes a number outside of its range.
    fn check_range(&self, number: f64) {
        if let Some(range) = self.range.filter(|range| !(range.low..=range.high).contains(&number)) {
            self.note(|| (self.place.clone(), short(number), range.allowed.to_owned()));
        }
    }

    /// Notes three numbers that are no unit vector.
    fn check_unit_vector(&self) {
        if let Some(vector) = self.value.and_then(vector)
            && directions::unit(vector).is_none()
        {
            self.note(|| {
                let (found, allowed) = directions::refusal(vector);
                (self.place.clone(), found, allowed)
            });
        }
    }

    fn integer<T: TryFrom<i64>>(&self, allowed: &str) -> Option<T> {
        let whole = |value: &DeValue<'_>| {
            let integer = value.as_integer()?;
            T::try_from(i64::from_str_radix(integer.as_str(), integer.radix()).ok()?).ok()
        };
        self.given(whole, allowed)
    }
}

/// The value of a key.
pub(super) fn get<'r>(table: &'r DeTable<'r>, key: &str) -> Option<&'r DeValue<'r>> {
    table.get(key).map(|value| value.get_ref())
}

/// Three numbers.
pub(super) fn vector(value: &DeValue<'_>) -> Option<[f64; 3]> {
    let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(|item| real(item.get_ref())).collect();
    numbers?.try_into().ok()
}

pub(super) fn real(value: &DeValue<'_>) -> Option<f64> {
    if let Some(integer) = value.as_integer() {
        return i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|integer| integer as f64);
    }
    let text = value.as_float()?.as_str();
    // Infinity is a number only where it is written as such.
    text.parse().ok().filter(|number: &f64| !number.is_infinite() || text.contains("inf"))
}

fn shown(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("string {text:?}"),
        DeValue::Integer(integer) => format!("integer `{}`", integer.as_str()),
        DeValue::Float(float) => format!("floating point `{}`", float.as_str()),
        DeValue::Boolean(truth) => format!("boolean `{truth}`"),
        DeValue::Datetime(time) => format!("the time {time}"),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// How what was written becomes what is allowed.
fn remedy(value: &DeValue<'_>, allowed: &str, key: &str) -> String {
    match value {
        DeValue::String(_) if allowed == "a number" => {
            " without quotes or unit: where there is a unit, the key ends in it".to_owned()
        }
        DeValue::String(text) if allowed == "a list" => format!(": [{text:?}]"),
        DeValue::Table(_) if allowed == "a list" => format!(": [[{key}]], in double brackets"),
        DeValue::Array(_) if allowed == "a table" => format!(": [{key}], in single brackets"),
        _ => String::new(),
    }
}

impl<'de> Deserializer<'de> for Reader<'_> {
    type Error = Error;

    /// Reads a value whose type the caller leaves open.
    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        match self.value {
            Some(DeValue::String(_)) => self.deserialize_string(visitor),
            Some(DeValue::Integer(_)) => self.deserialize_i64(visitor),
            Some(DeValue::Float(_)) => self.deserialize_f64(visitor),
            Some(DeValue::Array(_)) => self.deserialize_seq(visitor),
            Some(DeValue::Table(_)) => self.deserialize_map(visitor),
            Some(DeValue::Boolean(_)) => self.deserialize_bool(visitor),
            Some(DeValue::Datetime(_)) | None => {
                let allowed = "a number, a string (dates stand in quotes), true or false, a list";
                self.given(|_| None::<()>, allowed);
                visitor.visit_bool(false)
            }
        }
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        let number = self.given(real, "a number");
        number.into_iter().for_each(|number| self.check_range(number));
        visitor.visit_f64(number.unwrap_or(0.0))
    }

    fn deserialize_i64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_i64(self.integer("a whole number").unwrap_or(0))
    }

    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        let number: Option<u32> = self.integer("a whole number from 0 to 4294967295");
        number.into_iter().for_each(|number| self.check_range(number.into()));
        // Something is computed so many times.
        let [least, most] =
            self.range.map_or([0, u32::MAX], |it| [it.low, it.high].map(|bound| bound as u32));
        visitor.visit_u32(number.unwrap_or(0).clamp(least, most))
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Error> {
        if name == "UnitVector" {
            self.check_unit_vector();
        }
        visitor.visit_newtype_struct(Self { range: Range::of_type(name), ..self })
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_bool(self.given(DeValue::as_bool, "true or false").unwrap_or(false))
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        visitor.visit_str(self.given(DeValue::as_str, "a string").unwrap_or_default())
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        if self.value.is_some() { visitor.visit_some(self) } else { visitor.visit_none() }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        words: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        let text = self.given(DeValue::as_str, &words.join(", "));
        let known = text.and_then(|text| words.iter().find(|word| **word == text));
        if let (Some(text), None) = (text, known) {
            self.note(|| {
                let found = format!("the unknown word `{text}`{}", hint(text, words));
                (self.place.clone(), found, words.join(", "))
            });
            self.stand_in(self.place.clone());
        }
        visitor.visit_enum(known.or(words.first()).copied().unwrap_or_default().into_deserializer())
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        let list = self.given(DeValue::as_array, "a list").filter(|list| self.may_have(list.len()));
        let items = list.into_iter().flat_map(|list| list.iter()).enumerate();
        let items = items.map(|(i, value)| self.inside(self.place.item(i), Some(value.get_ref()), true));
        visitor.visit_seq(SeqDeserializer::new(items))
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Error> {
        let allowed = format!("a list of length {length}");
        let list = self.given(DeValue::as_array, &allowed);
        if let Some(list) = list.filter(|list| list.len() != length) {
            self.note(|| (self.place.clone(), format!("a list of length {}", list.len()), allowed));
            self.stand_in(self.place.clone());
        }
        let items = (0..length).map(|i| {
            let value = list.and_then(|list| list.get(i)).map(toml::Spanned::get_ref);
            self.inside(self.place.item(i), value, value.is_some())
        });
        visitor.visit_seq(SeqDeserializer::new(items))
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Error> {
        let table = self.given(DeValue::as_table, "a table").filter(|table| self.may_have(table.len()));
        let entries = table.into_iter().flat_map(|table| table.iter()).map(|(key, value)| {
            let key = key.get_ref().as_ref();
            (key, self.inside(self.place.key(key), Some(value.get_ref()), true))
        });
        visitor.visit_map(MapDeserializer::new(entries))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Error> {
        visitor.visit_map(MapDeserializer::new(self.fields(keys).into_iter()))
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i128 u8 u16 u64 u128 f32 char str bytes byte_buf unit unit_struct tuple_struct
        identifier ignored_any
    }
}

impl IntoDeserializer<'_> for Reader<'_> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}
