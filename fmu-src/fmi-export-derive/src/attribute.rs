//! The attributes: `#[parameter(...)]` and its siblings, `#[annotation(...)]`, `#[read_where(...)]`, `#[group(...)]`,
//! `#[variables(...)]`.

use model_description::{
    Annotation, Causality, Initial, InterpolationKind, ReadWhere, Variability, VariableRole,
};
use proc_macro2::Span;
use syn::{
    Attribute, Expr, Field, Ident, LitStr, Meta, Type, meta::ParseNestedMeta, parenthesized,
    spanned::Spanned, token,
};

use crate::field::FieldType;

/// `#[parameter(...)]`, `#[input(...)]` and so on.
#[derive(Default)]
pub(crate) struct Declaration {
    pub span: Option<Span>,
    pub causality: Causality,
    pub variability: Option<Variability>,
    pub initial: Option<Initial>,
    pub name: Option<LitStr>,
    pub unit: Option<LitStr>,
    pub display: Option<LitStr>,
    pub min: Option<Expr>,
    pub max: Option<Expr>,
    pub nominal: Option<Expr>,
    pub start: Option<Expr>,
    /// Items of a choice that the setup adds.
    pub items: Option<Expr>,
    /// `#[annotation(...)]` and every `#[read_where(...)]`.
    pub annotation: Option<Annotation>,
}

/// `#[group(...)]`.
#[derive(Default)]
pub(crate) struct Group {
    pub name: Option<LitStr>,
    pub count: Option<Expr>,
    pub setup: Option<Expr>,
}

/// Content of a field's attribute.
pub(crate) enum FieldAttribute {
    Declaration(Box<Declaration>),
    Group(Box<Group>),
}

const DECLARATION_ITEMS: &str = "constant, fixed, tunable, discrete, continuous, \
    initial = exact|approx|calculated, start, unit, display, min, max, nominal, name, items";

/// The one declaring attribute of a field; others (`doc`, `cfg`, ...) are none of our business. Without one, a type that no
/// variable has is a group.
pub(crate) fn of_field(name: &Ident, field: &Field) -> syn::Result<FieldAttribute> {
    let mut found = None;
    for attribute in &field.attrs {
        let Some(word) = attribute.path().get_ident() else { continue };
        let causality = match word.to_string().as_str() {
            "parameter" => Some(Causality::Parameter),
            "calculated_parameter" => Some(Causality::CalculatedParameter),
            "input" => Some(Causality::Input),
            "output" => Some(Causality::Output),
            "local" => Some(Causality::Local),
            "group" => None,
            _ => continue,
        };
        let parsed = match causality {
            Some(causality) => {
                let annotation = annotation(field)?;
                let declared = declaration(attribute, causality)?;
                FieldAttribute::Declaration(Box::new(Declaration { annotation, ..declared }))
            }
            None if annotation(field)?.is_some() => {
                return Err(syn::Error::new_spanned(word, "a group has no annotation; its variables have"));
            }
            None => FieldAttribute::Group(Box::new(group(attribute)?)),
        };
        if found.replace(parsed).is_some() {
            return Err(syn::Error::new_spanned(word, format!("`{name}` is declared twice")));
        }
    }
    let of_type = || FieldType::from_type(&field.ty).is_err().then(|| FieldAttribute::Group(Box::default()));
    found.or_else(of_type).ok_or_else(|| {
        let problem = format!(
            "`{name}` needs one of #[parameter], #[calculated_parameter], #[input], #[output], #[local], #[group]"
        );
        syn::Error::new(name.span(), problem)
    })
}

fn declaration(attribute: &Attribute, causality: Causality) -> syn::Result<Declaration> {
    let mut all = Declaration { span: Some(attribute.path().span()), causality, ..Declaration::default() };
    each_item(attribute, |item, word| {
        if let Some(variability) = Variability::from_word(word) {
            return once(&mut all.variability, item, |_| Ok(variability));
        }
        match word {
            "initial" => once(&mut all.initial, item, initial),
            "name" => once(&mut all.name, item, value),
            "unit" => once(&mut all.unit, item, value),
            "display" => once(&mut all.display, item, value),
            "min" => once(&mut all.min, item, value),
            "max" => once(&mut all.max, item, value),
            "nominal" => once(&mut all.nominal, item, value),
            "start" => once(&mut all.start, item, value),
            "items" => once(&mut all.items, item, value),
            _ => Err(item.error(format!("unknown item `{word}`; allowed: {DECLARATION_ITEMS}"))),
        }
    })?;
    Ok(all)
}

/// The annotation of a variable's field, if it has any.
fn annotation(field: &Field) -> syn::Result<Option<Annotation>> {
    let mut all: Option<Annotation> = None;
    let named = |name: &'static str| field.attrs.iter().filter(move |it| it.path().is_ident(name));
    for attribute in named("annotation") {
        let Annotation { also_called, limited_by, role, interpolation, rate, .. } =
            all.get_or_insert_default();
        each_item(attribute, |item, word| match word {
            "also_called" => once(also_called, item, text),
            "limited_by" => once(limited_by, item, text),
            "role" => once(role, item, |item| word_of(item, &VariableRole::ALL, VariableRole::as_str)),
            "interpolation" => once(interpolation, item, |item| {
                word_of(item, &InterpolationKind::ALL, InterpolationKind::as_str)
            }),
            "rate" => once(rate, item, text),
            _ => Err(item.error(format!(
                "unknown item `{word}`; allowed: also_called, limited_by, role, interpolation, rate"
            ))),
        })?;
    }
    for attribute in named("read_where") {
        let (mut option, mut items, mut set) = (None, None, None);
        each_item(attribute, |item, word| match word {
            "option" => once(&mut option, item, text),
            "items" => once(&mut items, item, text),
            "set" => once(&mut set, item, text),
            _ => Err(item.error(format!("unknown item `{word}`; allowed: option, items, set"))),
        })?;
        let (Some(option), Some(items)) = (option, items) else {
            return Err(syn::Error::new_spanned(attribute, "needs option = \"...\" and items = \"...\""));
        };
        let items = items.split_whitespace().map(str::to_owned).collect();
        all.get_or_insert_default().read_where.push(ReadWhere { option, items, set });
    }
    Ok(all)
}

fn text(item: &ParseNestedMeta<'_>) -> syn::Result<String> {
    value::<LitStr>(item).map(|text| text.value())
}

/// The variant of a word in quotes.
fn word_of<T: Copy>(
    item: &ParseNestedMeta<'_>,
    all: &[T],
    word: impl Fn(T) -> &'static str,
) -> syn::Result<T> {
    let given: LitStr = value(item)?;
    all.iter().copied().find(|known| word(*known) == given.value()).ok_or_else(|| {
        let allowed: Vec<&str> = all.iter().map(|known| word(*known)).collect();
        syn::Error::new(given.span(), format!("unknown `{}`; allowed: {}", given.value(), allowed.join(", ")))
    })
}

fn group(attribute: &Attribute) -> syn::Result<Group> {
    let mut all = Group::default();
    each_item(attribute, |item, word| match word {
        "name" => once(&mut all.name, item, value),
        "count" => once(&mut all.count, item, value),
        "setup" => once(&mut all.setup, item, value),
        _ => Err(item.error(format!("unknown item `{word}`; allowed: name, count, setup"))),
    })?;
    Ok(all)
}

/// The setup type of `#[variables(setup = Type)]`.
pub(crate) fn of_struct(attributes: &[Attribute]) -> syn::Result<(Option<Type>, Option<Expr>)> {
    let (mut setup, mut label) = (None, None);
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("variables")) {
        each_item(attribute, |item, word| match word {
            "setup" => once(&mut setup, item, value),
            "label" => once(&mut label, item, value),
            _ => Err(item.error(format!("unknown item `{word}`; allowed: setup = Type, label = expression"))),
        })?;
    }
    Ok((setup, label))
}

/// The name of `#[enumeration(name = "...")]`.
pub(crate) fn enumeration_name(attributes: &[Attribute]) -> syn::Result<Option<LitStr>> {
    let mut name = None;
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident("enumeration")) {
        each_item(attribute, |item, word| match word {
            "name" => once(&mut name, item, value),
            _ => Err(item.error(format!("unknown item `{word}`; allowed: name = \"...\""))),
        })?;
    }
    Ok(name)
}

fn each_item(
    attribute: &Attribute,
    mut read: impl FnMut(&ParseNestedMeta<'_>, &str) -> syn::Result<()>,
) -> syn::Result<()> {
    if matches!(attribute.meta, Meta::Path(_)) {
        return Ok(());
    }
    attribute.parse_nested_meta(|item| {
        let word = item.path.get_ident().map(Ident::to_string).unwrap_or_default();
        if item.input.peek(token::Paren) {
            let inner;
            parenthesized!(inner in item.input);
            return Err(inner.error(format!("write `{word} = ...`")));
        }
        read(&item, &word)
    })
}

fn once<T>(
    slot: &mut Option<T>,
    item: &ParseNestedMeta<'_>,
    read: impl FnOnce(&ParseNestedMeta<'_>) -> syn::Result<T>,
) -> syn::Result<()> {
    let value = read(item)?;
    match slot.replace(value) {
        None => Ok(()),
        Some(_) => Err(item.error("given twice")),
    }
}

fn value<T: syn::parse::Parse>(item: &ParseNestedMeta<'_>) -> syn::Result<T> {
    item.value()?.parse()
}

fn initial(item: &ParseNestedMeta<'_>) -> syn::Result<Initial> {
    let word: Ident = value(item)?;
    Initial::from_word(&word.to_string()).ok_or_else(|| {
        let allowed = Initial::ALL.map(Initial::as_str).join(", ");
        syn::Error::new(word.span(), format!("unknown initial `{word}`; allowed: {allowed}"))
    })
}
