//! Kernels that place bodies about a center, as a source to fit.

use std::path::PathBuf;

use physics::{
    bodies::Body,
    environment::{CartesianState, onboard::OnboardTarget},
};

use super::{
    chain, coverage,
    naif::{self, Center},
    spk_file::SpkFile,
};
use crate::ephemeris::{Failure, Source};

/// Open kernels; later ones take precedence.
pub struct Kernels {
    files: Vec<SpkFile>,
    center: Center,
    spacecraft: i32,
    title: String,
}

impl Kernels {
    /// Opens kernels, and looks whether they place the targets over a span; positions count from Mercury and the spacecraft is
    /// MESSENGER, unless others are given.
    ///
    /// # Errors
    ///
    /// A file that is no SPK, a body that none holds, a span that they do not cover.
    pub fn open(
        paths: &[PathBuf],
        center: Option<Center>,
        spacecraft: Option<i32>,
        targets: &[OnboardTarget],
        span_s: [f64; 2],
    ) -> Result<Self, Failure> {
        let files: Vec<SpkFile> = paths.iter().map(|path| SpkFile::open(path)).collect::<Result<_, _>>()?;
        let center = center.unwrap_or(Center { body: Body::Mercury, id: naif::id(Body::Mercury) });
        let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
        let mut title = format!("SPK {} from {}", names.join(", "), naif::named(center.id));
        if spacecraft.is_some() && !targets.contains(&OnboardTarget::Spacecraft) {
            return Err("--spacecraft: allowed where --bodies names the spacecraft".into());
        }
        if targets.contains(&OnboardTarget::Custom) && center.body != Body::Custom {
            return Err("--bodies custom: allowed where --center is the NAIF id of that body".into());
        }
        let spacecraft = spacecraft.unwrap_or(naif::MESSENGER);
        if targets.contains(&OnboardTarget::Spacecraft) {
            title += &format!(", spacecraft {spacecraft}");
        }
        let kernels = Self { files, center, spacecraft, title };
        for target in targets {
            coverage::check(&kernels.files, kernels.id(*target), center, span_s)?;
        }
        Ok(kernels)
    }

    fn id(&self, target: OnboardTarget) -> i32 {
        match target.body() {
            Some(body) if body == self.center.body => self.center.id,
            Some(body) => naif::id(body),
            None if target == OnboardTarget::Moon => naif::MOON,
            None => self.spacecraft,
        }
    }

    fn state(&self, target: OnboardTarget, at_s: f64) -> Result<CartesianState, String> {
        let (files, ids) = (&self.files[..], [self.id(target), self.center.id]);
        let [up, down] = ids.map(|id| chain::ancestors(files, id, at_s));
        let common = chain::common(&up, &down).ok_or_else(|| format!("--kernel: {target} is not placed"))?;
        let [target, center] = ids.map(|id| chain::state_from(files, id, common, at_s));
        Ok(target? - center?)
    }
}

impl Source for Kernels {
    fn center(&self) -> Body {
        self.center.body
    }

    fn title(&self) -> String {
        self.title.clone()
    }

    fn states(
        &self,
        targets: &[OnboardTarget],
        epochs_s: &[f64],
        reported: &mut dyn FnMut() -> Result<(), Failure>,
    ) -> Result<Vec<Vec<CartesianState>>, Failure> {
        let mut states = vec![Vec::with_capacity(epochs_s.len()); targets.len()];
        for at_s in epochs_s {
            for (target, states) in targets.iter().zip(&mut states) {
                states.push(self.state(*target, *at_s)?);
            }
            reported()?;
        }
        Ok(states)
    }
}
