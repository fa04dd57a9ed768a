//! The standard's words for causality, variability and the like: one table for writer, reader and messages.

use crate::{Causality, DependencyKind, Initial, NamingConvention, Variability};

macro_rules! words {
    ($type:ident, $what:literal, $($variant:ident => $word:literal),+ $(,)?) => {
        impl $type {
            #[doc = concat!("Every ", $what, ", in the standard's order.")]
            pub const ALL: &[Self] = &[$(Self::$variant),+];

            /// The word as it stands in the XML.
            pub const fn as_str(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }

            #[doc = concat!("The ", $what, " of an XML word.")]
            pub fn from_word(word: &str) -> Option<Self> {
                match word {
                    $($word => Some(Self::$variant),)+
                    _ => None,
                }
            }
        }

        impl core::fmt::Display for $type {
            fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                formatter.write_str(self.as_str())
            }
        }
    };
}

words!(Causality, "causality",
    Parameter => "parameter",
    CalculatedParameter => "calculatedParameter",
    Input => "input",
    Output => "output",
    Local => "local",
    Independent => "independent",
);

words!(Variability, "variability",
    Constant => "constant",
    Fixed => "fixed",
    Tunable => "tunable",
    Discrete => "discrete",
    Continuous => "continuous",
);

words!(Initial, "initial",
    Exact => "exact",
    Approx => "approx",
    Calculated => "calculated",
);

words!(DependencyKind, "dependency kind",
    Dependent => "dependent",
    Constant => "constant",
    Fixed => "fixed",
    Tunable => "tunable",
    Discrete => "discrete",
);

words!(NamingConvention, "naming convention",
    Flat => "flat",
    Structured => "structured",
);
