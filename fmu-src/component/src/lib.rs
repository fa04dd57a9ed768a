//! The shared library inside every heliotorque FMU: the models behind FMI's symbols, and nothing else.

#[cfg(all(
    any(target_os = "linux", target_os = "windows"),
    any(target_arch = "x86_64", target_arch = "aarch64")
))]
mod trigonometry;

fmi_export::export!(models::MomentumPlant, models::SpinPlant, models::DisturbanceTorque, models::Guidance);
