//! Reading of a model's variables in one call, as quantities of physics.

use core::ops::Deref;

use fmi_export::{
    Boolean, Choice, Context, Elements, Enumeration, Given, Integer, Model, Real, RealVector, Values,
};
use nalgebra::Vector3;

/// Values of a model's variables with the context of the call that reads them.
pub struct ValueReader<'a, M: Model> {
    /// Context of the call.
    pub context: &'a Context<'a, M>,
    /// The values, for groups of variables that read themselves.
    pub values: &'a Values,
}

impl<M: Model> Clone for ValueReader<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M: Model> Copy for ValueReader<'_, M> {}

impl<'a, M: Model> Deref for ValueReader<'a, M> {
    type Target = Context<'a, M>;

    fn deref(&self) -> &Context<'a, M> {
        self.context
    }
}

impl<'a, M: Model> ValueReader<'a, M> {
    /// Reads `values` in a call with this context.
    pub fn new(context: &'a Context<'a, M>, values: &'a Values) -> Self {
        Self { context, values }
    }

    /// A Real.
    pub fn real(&self, handle: Real) -> f64 {
        self.values.real(handle)
    }

    /// Three Reals as a vector.
    pub fn vector(&self, handle: RealVector<3>) -> Vector3<f64> {
        self.values.vector(handle).into()
    }

    /// An option.
    pub fn choice<E: Enumeration>(&self, handle: Choice<E>) -> E {
        self.values.choice(handle)
    }

    /// A Boolean.
    pub fn boolean(&self, handle: Boolean) -> bool {
        self.values.boolean(handle)
    }

    /// A number that is not negative.
    pub fn count(&self, handle: Integer) -> u32 {
        self.values.integer(handle).unsigned_abs()
    }

    /// The variables of a group that the user gave a value.
    pub fn given(&self, group: &[Elements]) -> Given<'a> {
        self.context.given(self.values, group)
    }

    /// The same by [`Context::given_deliberately`].
    pub fn given_deliberately(&self, group: &[Elements]) -> Given<'a> {
        self.context.given_deliberately(self.values, group)
    }
}
