//! The shared library inside every heliotorque FMU: the models behind FMI's symbols, and nothing else.

fmi_export::export!(models::MomentumPlant, models::SpinPlant, models::DisturbanceTorque, models::Guidance);
