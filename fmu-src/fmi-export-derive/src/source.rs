//! Reading of the source text: descriptions, names in lowerCamelCase, literal values, gathered errors.

use syn::{Attribute, Expr, ExprLit, ExprUnary, Lit, Meta, UnOp};

/// Errors of a whole item, so that one compilation shows them all.
#[derive(Default)]
pub(crate) struct Errors(Option<syn::Error>);

impl Errors {
    /// Adds an error.
    pub(crate) fn push(&mut self, error: syn::Error) {
        match &mut self.0 {
            Some(first) => first.combine(error),
            none => *none = Some(error),
        }
    }

    /// Keeps a value or the error instead of it.
    pub(crate) fn take<T>(&mut self, result: syn::Result<T>) -> Option<T> {
        result.map_err(|error| self.push(error)).ok()
    }

    /// The errors, if there were any.
    pub(crate) fn finish(self) -> syn::Result<()> {
        self.0.map_or(Ok(()), Err)
    }
}

/// The doc comment as one line; `None` if there is none or it is blank.
pub(crate) fn description(attributes: &[Attribute]) -> Option<String> {
    let mut words = Vec::new();
    for attribute in attributes {
        if let Meta::NameValue(pair) = &attribute.meta
            && pair.path.is_ident("doc")
            && let Expr::Lit(ExprLit { lit: Lit::Str(line), .. }) = &pair.value
        {
            words.extend(line.value().split_whitespace().map(str::to_owned));
        }
    }
    (!words.is_empty()).then(|| words.join(" "))
}

/// `center_of_mass` as `centerOfMass`.
pub(crate) fn camel_from_snake(identifier: &str) -> String {
    let mut name = String::new();
    for segment in identifier.trim_start_matches("r#").split('_').filter(|segment| !segment.is_empty()) {
        let mut letters = segment.chars();
        match letters.next() {
            Some(first) if !name.is_empty() => name.extend(first.to_uppercase()),
            Some(first) => name.push(first),
            None => {}
        }
        name.push_str(letters.as_str());
    }
    name
}

/// `SunOffset` as `sunOffset`, `EME2000` as `eme2000`, `XMLFile` as `xmlFile`.
pub(crate) fn camel_from_pascal(identifier: &str) -> String {
    let letters: Vec<char> = identifier.trim_start_matches("r#").chars().collect();
    let capitals = letters.iter().take_while(|letter| letter.is_uppercase()).count();
    let starts_a_word = letters.get(capitals).is_some_and(|next| next.is_lowercase());
    let lowered = if starts_a_word && capitals > 1 { capitals - 1 } else { capitals };
    let head = letters.iter().take(lowered).flat_map(|letter| letter.to_lowercase());
    head.chain(letters.iter().skip(lowered).copied()).collect()
}

/// The numbers of a literal, or of an array of literals; `None` where only the running program knows.
pub(crate) fn literal_numbers(expression: &Expr) -> Option<Vec<f64>> {
    match expression {
        Expr::Lit(ExprLit { lit: Lit::Float(value), .. }) => Some(vec![value.base10_parse().ok()?]),
        Expr::Lit(ExprLit { lit: Lit::Int(value), .. }) => Some(vec![value.base10_parse().ok()?]),
        Expr::Unary(ExprUnary { op: UnOp::Neg(_), expr, .. }) => {
            Some(literal_numbers(expr)?.into_iter().map(|value| -value).collect())
        }
        Expr::Paren(inner) => literal_numbers(&inner.expr),
        Expr::Group(inner) => literal_numbers(&inner.expr),
        Expr::Repeat(array) => literal_numbers(&array.expr),
        Expr::Array(array) => {
            let elements: Option<Vec<_>> = array.elems.iter().map(literal_numbers).collect();
            Some(elements?.concat())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_become_lower_camel_case() {
        for (snake, camel) in [
            ("mass", "mass"),
            ("center_of_mass", "centerOfMass"),
            ("_delta_v_x", "deltaVX"),
            ("r#type", "type"),
        ] {
            assert_eq!(camel_from_snake(snake), camel);
        }
        for (pascal, camel) in [
            ("Guided", "guided"),
            ("SunOffset", "sunOffset"),
            ("EME2000", "eme2000"),
            ("XMLFile", "xmlFile"),
            ("A", "a"),
        ] {
            assert_eq!(camel_from_pascal(pascal), camel);
        }
    }

    #[test]
    fn only_literals_have_numbers_at_compile_time() {
        let numbers = |text| literal_numbers(&syn::parse_str(text).unwrap());
        assert_eq!(numbers("-1.5"), Some(vec![-1.5]));
        assert_eq!(numbers("[[1, 2], [-(3), 4]]"), Some(vec![1.0, 2.0, -3.0, 4.0]));
        assert_eq!(numbers("[0.0; 3]"), Some(vec![0.0]));
        assert_eq!(numbers("setup.mass_kg"), None);
        assert_eq!(numbers("[0.0, x]"), None);
    }
}
