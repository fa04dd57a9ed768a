//! The code of `#[derive(Enumeration)]`.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Data, DataEnum, DeriveInput, Expr, ExprLit, Fields, Lit, Variant, spanned::Spanned};

use crate::attribute::enumeration_name;
use crate::check;
use crate::source::{Errors, camel_from_pascal, description};

/// Expands the derive.
pub(crate) fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    let Data::Enum(data) = &input.data else {
        return Err(syn::Error::new(input.ident.span(), "Enumeration can be derived for an enum only"));
    };
    if data.variants.is_empty() {
        return Err(syn::Error::new(input.ident.span(), "an enumeration needs at least one item"));
    }
    let mut errors = Errors::default();
    let type_name = errors.take(enumeration_name(&input.attrs)).flatten();
    let type_name = check::name_or(type_name.as_ref(), || input.ident.to_string());
    let about = description(&input.attrs);
    if about.is_none() {
        let problem = "the enum needs a doc comment: it is the type's description";
        errors.push(syn::Error::new(input.ident.span(), problem));
    }
    let items = items(data, &mut errors);
    errors.finish()?;

    let ident = &input.ident;
    let variants: Vec<_> = data.variants.iter().map(|variant| &variant.ident).collect();
    let values: Vec<_> = items.iter().map(|item| item.value).collect();
    let names = items.iter().map(|item| &item.name);
    let descriptions = items.iter().map(|item| &item.description);
    let first = variants.first();
    Ok(quote! {
        #[automatically_derived]
        impl ::fmi_export::Enumeration for #ident {
            const FIRST: Self = Self::#first;

            const TYPE: ::fmi_export::variables::EnumerationType = ::fmi_export::variables::EnumerationType {
                name: #type_name,
                description: #about,
                items: &[#(
                    ::fmi_export::variables::Item { name: #names, value: #values, description: #descriptions }
                ),*],
            };

            fn from_value(value: i32) -> ::core::option::Option<Self> {
                match value {
                    #(#values => ::core::option::Option::Some(Self::#variants),)*
                    _ => ::core::option::Option::None,
                }
            }

            fn value(self) -> i32 {
                match self {
                    #(Self::#variants => #values,)*
                }
            }
        }
    })
}

struct Item {
    name: String,
    value: i32,
    description: String,
}

fn items(data: &DataEnum, errors: &mut Errors) -> Vec<Item> {
    let mut names = Vec::new();
    let mut items: Vec<Item> = Vec::new();
    for variant in &data.variants {
        let before = items.last().map_or(0, |item| item.value);
        let Some(item) = errors.take(item(variant, before, &mut names)) else { continue };
        if items.iter().any(|other| other.value == item.value) {
            let problem = format!("two items have the value {}", item.value);
            errors.push(syn::Error::new(variant.ident.span(), problem));
        }
        items.push(item);
    }
    items
}

fn item(variant: &Variant, before: i32, names: &mut Vec<String>) -> syn::Result<Item> {
    let ident = &variant.ident;
    if !matches!(variant.fields, Fields::Unit) {
        return Err(syn::Error::new(variant.fields.span(), "an item has no fields"));
    }
    let given = enumeration_name(&variant.attrs)?;
    let name = check::name_or(given.as_ref(), || camel_from_pascal(&ident.to_string()));
    check::name(&name, "", ident.span(), names)?;
    let description = description(&variant.attrs).ok_or_else(|| {
        syn::Error::new(ident.span(), format!("`{ident}` needs a doc comment: it is the item's description"))
    })?;
    let value = match &variant.discriminant {
        Some((_, expression)) => discriminant(expression, &name)?,
        None => before
            .checked_add(1)
            .ok_or_else(|| syn::Error::new(ident.span(), "the item's value does not fit an Integer"))?,
    };
    Ok(Item { name, value, description })
}

/// Items count from 1; 0 is what masters send before they have a choice.
fn discriminant(expression: &Expr, name: &str) -> syn::Result<i32> {
    let value = match expression {
        Expr::Lit(ExprLit { lit: Lit::Int(value), .. }) => value.base10_parse::<i32>().ok(),
        _ => None,
    };
    let least = if name == "none" { 0 } else { 1 };
    value.filter(|value| *value >= least).ok_or_else(|| {
        let problem = "an item's value is a literal integer from 1 to 2147483647, or 0 if it is named `none`";
        syn::Error::new_spanned(expression, problem)
    })
}
