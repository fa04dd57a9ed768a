//! The code of `#[derive(Variables)]`: one call of the builder a field.

use model_description::{Annotation, ReadWhere, Variability};
use proc_macro2::{Span, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote, quote_spanned};
use syn::{Data, DeriveInput, Expr, Field, Fields, Ident, spanned::Spanned};

use crate::attribute::{self, Declaration, FieldAttribute, Group};
use crate::check;
use crate::field::{FieldType, element_of_vec};
use crate::source::{Errors, camel_from_snake, description};

/// Expands the derive.
pub(crate) fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    let fields = named_fields(input)?;
    // Hygienic: an expression of the user's must not see the builder.
    let scope = Ident::new("scope", Span::mixed_site());
    let mut expansion = Expansion { scope: &scope, names: Vec::new(), errors: Errors::default() };
    let (setup, label) = expansion.errors.take(attribute::of_struct(&input.attrs)).unwrap_or_default();
    let mut statements = Vec::new();
    let mut members = Vec::new();
    let mut parts = Vec::new();
    for (position, (ident, field)) in fields.iter().enumerate() {
        let binding = Ident::new(&format!("field_{position}"), Span::mixed_site());
        let Some(attribute) = expansion.errors.take(attribute::of_field(ident, field)) else { continue };
        let call = match &attribute {
            FieldAttribute::Declaration(declared) => expansion.variable(declared, ident, field),
            FieldAttribute::Group(group) => expansion.group(group, ident, field),
        };
        let ty = &field.ty;
        statements.extend(call.map(|call| quote! { let #binding: #ty = #call?; }));
        members.push(quote! { #ident: #binding });
        parts.push(match &attribute {
            FieldAttribute::Declaration(_) => quote! { .and(self.#ident) },
            FieldAttribute::Group(_) => quote! { .and(&self.#ident) },
        });
    }
    expansion.errors.finish()?;

    let label = label.as_ref().map(borrowed).map(|label| quote! { #scope.label(#label); });
    let struct_name = &input.ident;
    let (own_generics, type_generics, where_clause) = input.generics.split_for_impl();
    let mut generics = input.generics.clone();
    let setup = match setup {
        Some(ty) => quote! { #ty },
        None if mentions(input.to_token_stream(), "setup") => quote! { Setup },
        None => {
            let parameter = format_ident!("AnySetup", span = Span::mixed_site());
            generics.params.push(syn::parse_quote! { #parameter });
            quote! { #parameter }
        }
    };
    let (impl_generics, _, _) = generics.split_for_impl();
    Ok(quote! {
        #[automatically_derived]
        impl #impl_generics ::fmi_export::Variables<#setup> for #struct_name #type_generics #where_clause {
            fn declare(
                #scope: &mut ::fmi_export::Declare,
                setup: &#setup,
                index: usize,
            ) -> ::core::result::Result<Self, ::fmi_export::DeclareError> {
                let _ = (&*#scope, setup, index);
                #label
                #(#statements)*
                ::core::result::Result::Ok(Self { #(#members),* })
            }
        }

        #[automatically_derived]
        impl #own_generics ::fmi_export::Section for #struct_name #type_generics #where_clause {
            fn section(&self) -> ::fmi_export::Knowns {
                ::fmi_export::Knowns::default()#(#parts)*
            }
        }
    })
}

fn named_fields(input: &DeriveInput) -> syn::Result<Vec<(&Ident, &Field)>> {
    match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(fields) => {
                return Ok(fields.named.iter().filter_map(|it| Some((it.ident.as_ref()?, it))).collect());
            }
            Fields::Unit => return Ok(Vec::new()),
            Fields::Unnamed(_) => {}
        },
        Data::Enum(_) | Data::Union(_) => {}
    }
    Err(syn::Error::new(input.ident.span(), "Variables can be derived for a struct with named fields only"))
}

/// State of the expansion of one struct.
struct Expansion<'s> {
    scope: &'s Ident,
    names: Vec<String>,
    errors: Errors,
}

impl Expansion<'_> {
    fn variable(&mut self, declared: &Declaration, ident: &Ident, field: &Field) -> Option<TokenStream> {
        let Self { scope, names, errors } = self;
        let kind = errors.take(FieldType::from_type(&field.ty))?;
        check::declaration(declared, kind, ident, errors);
        let (name, place) = named(declared.name.as_ref(), ident);
        errors.take(check::name(&name, kind.first_element(), place, names));
        let Some(description) = description(&field.attrs) else {
            let problem = format!("`{ident}` needs a doc comment: it is the variable's description");
            errors.push(syn::Error::new(ident.span(), problem));
            return None;
        };
        let role = role_tokens(declared, check::variability(declared, kind));
        let (min, max) = (option(declared.min.as_ref()), option(declared.max.as_ref()));
        let start = option(declared.start.as_ref());
        let spec = quote! {
            &::fmi_export::variables::ScalarSpec { name: #name, description: #description, role: #role }
        };
        let annotation = declared.annotation.as_ref().map(annotation_tokens);
        let scope = match annotation {
            Some(annotation) => quote! { #scope.annotate(#annotation) },
            None => quote! { #scope },
        };
        Some(match kind {
            FieldType::Real | FieldType::RealVector | FieldType::RealMatrix => {
                let unit = declared.unit.as_ref().map(syn::LitStr::value);
                let display = option(declared.display.as_ref());
                let nominal = option(declared.nominal.as_ref());
                let method = match kind {
                    FieldType::RealVector => quote! { real_vector },
                    FieldType::RealMatrix => quote! { real_matrix },
                    _ => quote! { real },
                };
                quote! {
                    #scope.#method(
                        &::fmi_export::variables::RealSpec {
                            name: #name,
                            description: #description,
                            role: #role,
                            unit: #unit,
                            display_unit: #display,
                            min: #min,
                            max: #max,
                            nominal: #nominal,
                        },
                        #start,
                    )
                }
            }
            FieldType::Integer => quote! { #scope.integer(#spec, #start, #min, #max) },
            FieldType::Boolean => quote! { #scope.boolean(#spec, #start) },
            FieldType::Choice => match &declared.items {
                Some(items) => quote_spanned! { items.span()=> #scope.choice(#spec, #start, #items) },
                None => quote! { #scope.choice(#spec, #start, ::std::vec::Vec::new()) },
            },
            FieldType::Text => {
                let start = option(declared.start.as_ref().map(borrowed).as_ref());
                quote! { #scope.text(#spec, #start) }
            }
        })
    }

    fn group(&mut self, group: &Group, ident: &Ident, field: &Field) -> Option<TokenStream> {
        let Self { scope, errors, .. } = self;
        let (name, place) = named(group.name.as_ref(), ident);
        errors.take(check::group_name(&name, group.count.is_some(), place));
        let element = match (element_of_vec(&field.ty), &group.count) {
            (Some(element), Some(_)) => element,
            (None, None) => &field.ty,
            (None, Some(_)) => {
                errors.push(syn::Error::new_spanned(&field.ty, "a group with `count` is a Vec<...>"));
                return None;
            }
            (Some(_), None) => {
                errors
                    .push(syn::Error::new_spanned(&field.ty, "a Vec of groups needs #[group(count = ...)]"));
                return None;
            }
        };
        let setup = group.setup.as_ref().map_or_else(|| quote! { setup }, |setup| quote! { #setup });
        let declare = quote_spanned! { element.span()=>
            <#element as ::fmi_export::Variables<_>>::declare(#scope, #setup, index)
        };
        Some(match &group.count {
            Some(count) => quote! { #scope.groups(#name, #count, |#scope, index| #declare) },
            None => quote! { #scope.group(#name, |#scope| #declare) },
        })
    }
}

/// The name that is given, or that of the field in lowerCamelCase, and its place in the source.
fn named(given: Option<&syn::LitStr>, ident: &Ident) -> (String, Span) {
    given.map_or_else(|| (camel_from_snake(&ident.to_string()), ident.span()), |it| (it.value(), it.span()))
}

/// Whether a word stands in tokens, at any depth.
fn mentions(tokens: TokenStream, word: &str) -> bool {
    tokens.into_iter().any(|token| match token {
        TokenTree::Ident(ident) => ident == word,
        TokenTree::Group(group) => mentions(group.stream(), word),
        TokenTree::Punct(_) | TokenTree::Literal(_) => false,
    })
}

/// The text of an expression.
fn borrowed(text: &Expr) -> TokenStream {
    quote_spanned! { text.span()=> ::core::convert::AsRef::<str>::as_ref(&#text) }
}

fn option(expression: Option<&(impl Spanned + ToTokens)>) -> TokenStream {
    match expression {
        Some(expression) => quote_spanned! { expression.span()=> ::core::option::Option::Some(#expression) },
        None => quote! { ::core::option::Option::None },
    }
}

fn annotation_tokens(annotation: &Annotation) -> TokenStream {
    let Annotation { also_called, limited_by, role, interpolation, rate, read_where } = annotation;
    let text = |text: &String| quote! { ::std::string::String::from(#text) };
    let optional = |given: &Option<String>| match given.as_ref().map(text) {
        Some(given) => quote! { ::core::option::Option::Some(#given) },
        None => quote! { ::core::option::Option::None },
    };
    let word = |given: Option<(&str, String)>| match given {
        Some((of, variant)) => {
            let (of, variant) = (format_ident!("{of}"), format_ident!("{variant}"));
            quote! { ::core::option::Option::Some(::fmi_export::variables::#of::#variant) }
        }
        None => quote! { ::core::option::Option::None },
    };
    let (also_called, limited_by, rate) = (optional(also_called), optional(limited_by), optional(rate));
    let role = word(role.map(|it| ("VariableRole", format!("{it:?}"))));
    let interpolation = word(interpolation.map(|it| ("InterpolationKind", format!("{it:?}"))));
    let read_where = read_where.iter().map(|ReadWhere { option, items, set }| {
        let (option, items, set) = (text(option), items.iter().map(text), optional(set));
        quote! {
            ::fmi_export::variables::ReadWhere { option: #option, items: ::std::vec![#(#items),*], set: #set }
        }
    });
    quote! {
        ::fmi_export::variables::Annotation {
            also_called: #also_called,
            limited_by: #limited_by,
            role: #role,
            interpolation: #interpolation,
            rate: #rate,
            read_where: ::std::vec![#(#read_where),*],
        }
    }
}

fn role_tokens(declared: &Declaration, variability: Variability) -> TokenStream {
    let variant = |name: &dyn core::fmt::Debug| Ident::new(&format!("{name:?}"), Span::call_site());
    let (causality, variability) = (variant(&declared.causality), variant(&variability));
    let initial = match declared.initial.map(|initial| variant(&initial)) {
        Some(initial) => quote! { ::core::option::Option::Some(::fmi_export::variables::Initial::#initial) },
        None => quote! { ::core::option::Option::None },
    };
    quote! {
        ::fmi_export::variables::Role {
            causality: ::fmi_export::variables::Causality::#causality,
            variability: ::fmi_export::variables::Variability::#variability,
            initial: #initial,
        }
    }
}
