//! An enumeration is a described enum without fields whose items count from 1.

use fmi_export::Enumeration;

#[derive(Clone, Copy, Enumeration)]
enum Undescribed {
    /// An item.
    A,
    B,
}

/// Values.
#[derive(Clone, Copy, Enumeration)]
enum Values {
    /// Zero.
    Zero = 0,
    /// Negative.
    Negative = -1,
    /// Not a literal.
    Computed = 1 + 2,
}

/// Without discriminants the first item is 1, so that `B` is 2 already.
#[derive(Clone, Copy, Enumeration)]
enum Counted {
    /// One.
    A,
    /// Two.
    B,
    /// Two again.
    C = 2,
}

/// Items.
#[derive(Clone, Copy, Enumeration)]
enum Items {
    /// Has a field.
    Field(u8),
    /// One.
    Same,
    /// Another of the same name.
    #[enumeration(name = "same")]
    Other,
}

/// Empty.
#[derive(Clone, Copy, Enumeration)]
enum Empty {}

/// No enum.
#[derive(Clone, Copy, Enumeration)]
struct Struct;

fn main() {}
