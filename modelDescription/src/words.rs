//! The standard's words: enumerations whose variants stand next to their words, one table for writer, reader and messages.

/// Declares an enumeration; `$method` gives a variant's word.
macro_rules! words {
    (
        $(#[$meta:meta])*
        pub enum $type:ident, $method:ident {
            $($(#[$doc:meta])* $variant:ident $(= $value:literal)? => $word:literal,)+
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $type {
            $($(#[$doc])* $variant $(= $value)?),+
        }

        impl $type {
            /// Every variant, in the standard's order.
            pub const ALL: [Self; [$($word),+].len()] = [$(Self::$variant),+];

            /// The word.
            pub const fn $method(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }
        }

        impl core::fmt::Display for $type {
            fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                formatter.write_str(self.$method())
            }
        }
    };
}
pub(crate) use words;

/// [`words!`] that are values of attributes in the XML.
macro_rules! attribute_words {
    ($(#[$meta:meta])* pub enum $type:ident { $($rest:tt)* }) => {
        words! {
            $(#[$meta])*
            #[allow(missing_docs, reason = "the standard's own words")]
            pub enum $type, as_str { $($rest)* }
        }

        impl $type {
            /// The variant of a word.
            pub fn from_word(word: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|known| known.as_str() == word)
            }
        }

        impl crate::lexical::Lexical for $type {
            fn allowed() -> String {
                format!("one of {}", Self::ALL.map(Self::as_str).join(", "))
            }

            fn parse(text: &str) -> Option<Self> {
                Self::from_word(text)
            }

            fn text(&self) -> std::borrow::Cow<'_, str> {
                self.as_str().into()
            }
        }
    };
}

attribute_words! {
    /// `variableNamingConvention` (2.2.9).
    #[derive(Default)]
    pub enum NamingConvention {
        #[default]
        Flat => "flat",
        Structured => "structured",
    }
}

attribute_words! {
    /// `causality` (2.2.7).
    #[derive(Default)]
    pub enum Causality {
        Parameter => "parameter",
        CalculatedParameter => "calculatedParameter",
        Input => "input",
        Output => "output",
        #[default]
        Local => "local",
        Independent => "independent",
    }
}

attribute_words! {
    /// `variability` (2.2.7).
    #[derive(Default)]
    pub enum Variability {
        Constant => "constant",
        Fixed => "fixed",
        Tunable => "tunable",
        Discrete => "discrete",
        #[default]
        Continuous => "continuous",
    }
}

attribute_words! {
    /// `initial` (2.2.7).
    pub enum Initial {
        Exact => "exact",
        Approx => "approx",
        Calculated => "calculated",
    }
}

attribute_words! {
    /// `role` of an annotated variable: `Epoch` is in s past J2000 TDB, as a parameter that of the start; `LitFraction` the visible
    /// part of the Sun's disc; `NextEvent` the time of the next event.
    pub enum VariableRole {
        Epoch => "epoch",
        LitFraction => "litFraction",
        NextEvent => "nextEvent",
    }
}

attribute_words! {
    /// `interpolation` of an annotated variable: `Attitude` is an element of a quaternion, scalar last; `Angle` comes back after a
    /// turn; `Position` is a cubic by its rate.
    pub enum InterpolationKind {
        Attitude => "attitude",
        Angle => "angle",
        Position => "position",
    }
}

attribute_words! {
    /// One entry of `dependenciesKind`.
    pub enum DependencyKind {
        Dependent => "dependent",
        Constant => "constant",
        Fixed => "fixed",
        Tunable => "tunable",
        Discrete => "discrete",
    }
}
