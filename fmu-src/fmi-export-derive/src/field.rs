//! The field types a variable can have.

use syn::{GenericArgument, PathArguments, Type};

/// Handle type of a field.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum FieldType {
    Real,
    RealVector,
    RealMatrix,
    Integer,
    Boolean,
    Text,
    Choice,
}

impl FieldType {
    /// The kind of a type, by the last segment of its path.
    pub(crate) fn from_type(ty: &Type) -> syn::Result<Self> {
        let name = match ty {
            Type::Path(path) => path.path.segments.last().map(|segment| segment.ident.to_string()),
            _ => None,
        };
        match name.as_deref() {
            Some("Real") => Ok(Self::Real),
            Some("RealVector") => Ok(Self::RealVector),
            Some("RealMatrix") => Ok(Self::RealMatrix),
            Some("Integer") => Ok(Self::Integer),
            Some("Boolean") => Ok(Self::Boolean),
            Some("Text") => Ok(Self::Text),
            Some("Choice") => Ok(Self::Choice),
            _ => Err(syn::Error::new_spanned(
                ty,
                "a variable is a Real, RealVector<N>, RealMatrix<R, C>, Integer, Boolean, Text or Choice<E>; \
                 a struct of variables needs #[group]",
            )),
        }
    }

    /// Whether the base type is Real.
    pub(crate) fn is_real(self) -> bool {
        matches!(self, Self::Real | Self::RealVector | Self::RealMatrix)
    }

    /// Returns the indices in the name of the first element.
    pub(crate) fn first_element(self) -> &'static str {
        match self {
            Self::RealVector => "[1]",
            Self::RealMatrix => "[1,1]",
            _ => "",
        }
    }
}

/// `T` of `Vec<T>`.
pub(crate) fn element_of_vec(ty: &Type) -> Option<&Type> {
    let Type::Path(path) = ty else { return None };
    let last = path.path.segments.last().filter(|segment| segment.ident == "Vec")?;
    let PathArguments::AngleBracketed(arguments) = &last.arguments else { return None };
    match arguments.args.first() {
        Some(GenericArgument::Type(element)) => Some(element),
        _ => None,
    }
}
