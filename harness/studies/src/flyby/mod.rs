//! Paper 003: flybys of Mercury aimed by sunlight, simulated through MomentumPlant.
//!
//! The paper prints neither state nor spacecraft, corridor or aimpoint: all of these are those of the shipped missions.

mod corridor;
mod desired;
mod early;
mod leg;
mod mission;
mod plane;
mod steps;
mod tables;
mod traditional;

pub(crate) use corridor::figure4;
pub(crate) use desired::figure5;
pub(crate) use early::figure3;
pub(crate) use steps::{figure6, figure7, figure8, figure9};
pub(crate) use tables::{table1, table2, table3};
