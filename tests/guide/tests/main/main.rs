//! The guide is complete, its links lead somewhere, and its commands exist.

mod chapters;
mod commands;
mod formulas;
mod html;
mod links;
mod markdown;
