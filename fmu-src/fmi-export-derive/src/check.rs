//! Checks of a declaration at compile time.

use model_description::{
    Causality, Variability, names,
    rules::{self, RoleFault},
    units,
};
use proc_macro2::Span;
use syn::{Expr, Ident, LitStr, spanned::Spanned};

use crate::attribute::Declaration;
use crate::field::FieldType;
use crate::source::{Errors, literal_numbers};

/// Checks one declaration; `field` is where an error without a place of its own points to.
pub(crate) fn declaration(declared: &Declaration, kind: FieldType, field: &Ident, errors: &mut Errors) {
    errors.take(role(declared, kind, field));
    errors.take(unit(declared, kind, field));
    errors.take(limits(declared, kind));
    if let Some(items) = declared.items.as_ref().filter(|_| kind != FieldType::Choice) {
        errors.push(syn::Error::new_spanned(items, "only a Choice has items"));
    }
}

/// The variability given, or the causality's usual one.
pub(crate) fn variability(declared: &Declaration, kind: FieldType) -> Variability {
    declared.variability.unwrap_or(match declared.causality {
        Causality::Parameter | Causality::CalculatedParameter => Variability::Fixed,
        _ if kind.is_real() => Variability::Continuous,
        _ => Variability::Discrete,
    })
}

fn role(declared: &Declaration, kind: FieldType, field: &Ident) -> syn::Result<()> {
    let variability = variability(declared, kind);
    let Declaration { causality, initial, start, .. } = declared;
    let is_real = kind.is_real();
    rules::check_role(*causality, variability, *initial, is_real, start.is_some()).map_err(
        |fault| match fault {
            RoleFault::Role(problem) => {
                syn::Error::new(declared.span.unwrap_or_else(Span::call_site), problem)
            }
            RoleFault::StartMissing(problem) => syn::Error::new(field.span(), format!("`{field}` {problem}")),
            RoleFault::StartForbidden(problem) => {
                syn::Error::new_spanned(start, format!("`{field}` {problem}"))
            }
        },
    )
}

fn unit(declared: &Declaration, kind: FieldType, field: &Ident) -> syn::Result<()> {
    let only_real =
        |place: Span, item: &str| Err(syn::Error::new(place, format!("only a Real has a {item}")));
    if !kind.is_real() {
        return match (&declared.unit, &declared.display, &declared.nominal) {
            (Some(unit), _, _) => only_real(unit.span(), "unit"),
            (_, Some(display), _) => only_real(display.span(), "display unit"),
            (_, _, Some(nominal)) => only_real(nominal.span(), "nominal value"),
            _ => Ok(()),
        };
    }
    let Some(unit) = &declared.unit else {
        return Err(syn::Error::new(
            field.span(),
            format!("`{field}` needs a unit; dimensionless is `unit = \"1\"`"),
        ));
    };
    let Some(known) = units::find(&unit.value()) else {
        let problem = format!(
            "unknown unit `{}`; the allowed ones are the rows of `model_description::units::UNITS`",
            unit.value()
        );
        return Err(syn::Error::new(unit.span(), problem));
    };
    match &declared.display {
        Some(display) if !known.has_display(&display.value()) => {
            let allowed = rules::listed(known.display.iter().map(|(name, _)| *name));
            Err(syn::Error::new(
                display.span(),
                format!("`{}` is no display unit of `{}`; allowed: {allowed}", display.value(), known.name),
            ))
        }
        _ => Ok(()),
    }
}

fn limits(declared: &Declaration, kind: FieldType) -> syn::Result<()> {
    let Declaration { min, max, nominal, start, .. } = declared;
    if let Some(limit) = min.as_ref().or(max.as_ref())
        && !(kind.is_real() || kind == FieldType::Integer)
    {
        return Err(syn::Error::new_spanned(limit, "only a Real or an Integer has limits"));
    }
    let literal =
        |expression: &Option<Expr>| expression.as_ref().and_then(literal_numbers).unwrap_or_default();
    let (lows, highs, starts) = (literal(min), literal(max), literal(start));
    let above = |low: &[f64], high: &[f64]| low.iter().any(|low| high.iter().any(|high| low > high));
    let faults = [
        (above(&lows, &highs), min, "`min` is above `max`"),
        (above(&lows, &starts), start, "`start` is below `min`"),
        (above(&starts, &highs), start, "`start` is above `max`"),
        (literal(nominal).iter().any(|value| *value <= 0.0), nominal, "`nominal` must be above 0"),
    ];
    match faults.into_iter().find(|(holds, ..)| *holds) {
        Some((_, place, problem)) => Err(syn::Error::new_spanned(place, problem)),
        None => Ok(()),
    }
}

/// Checks a structured name (FMI 2.0.5, 2.2.9) and that it is new among `known`.
pub(crate) fn name(given: &str, suffix: &str, place: Span, known: &mut Vec<String>) -> syn::Result<()> {
    let full = format!("{given}{suffix}");
    structured(&full, &full, place)?;
    if known.iter().any(|other| other == given) {
        return Err(syn::Error::new(place, format!("two names are `{given}`")));
    }
    known.push(given.to_owned());
    Ok(())
}

/// Checks the name of a group, which may be empty (no prefix) unless it is counted.
pub(crate) fn group_name(given: &str, counted: bool, place: Span) -> syn::Result<()> {
    if given.is_empty() && !counted {
        return Ok(());
    }
    let prefix = if counted { format!("{given}[1]") } else { given.to_owned() };
    structured(&prefix, &format!("{prefix}.x"), place)
}

fn structured(shown: &str, full: &str, place: Span) -> syn::Result<()> {
    names::check_structured(full)
        .map_err(|problem| syn::Error::new(place, format!("the name `{shown}` {problem}")))
}

/// The text of a name attribute, or else the default.
pub(crate) fn name_or(given: Option<&LitStr>, default: impl FnOnce() -> String) -> String {
    given.map_or_else(default, LitStr::value)
}
