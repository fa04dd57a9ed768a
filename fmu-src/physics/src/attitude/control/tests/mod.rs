//! Tests of attitude control.
