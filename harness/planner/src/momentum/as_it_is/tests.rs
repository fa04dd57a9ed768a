//! Plans that a mission has already.
