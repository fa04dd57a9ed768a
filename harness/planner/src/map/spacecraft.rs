//! Spacecraft that is mapped: the FMU of a file, how its panels follow the Sun, zone, downlinks and thresholds.

use files::{Entries, Scratch};
use fmi::{Described, Fmu, Value};
use inputs::{kind::FileKind, variables};
use model_description::Description;
use nalgebra::Vector3;
use packing::{
    assembly::{START, Source, description, model_of, open_template, with_values},
    instance::started,
};
use physics::{
    bodies::Body,
    constants::ASTRONOMICAL_UNIT_M as AU_M,
    enumeration::Enumerated,
    spacecraft::{
        Articulation, DownlinkWindows, Panel, PanelControl, Spacecraft, TimeAfterPeriapsis, offset_for_suns,
    },
    spin::spinner::Spinner,
};

use super::options::Map;
use crate::{
    Failure,
    torque_map::{Angles, LitSpacecraft, Rule, TurnedPanels},
};

/// The model whose torque is mapped.
const MODEL: &str = "DisturbanceTorque";
/// The model whose parameters say how it is simulated.
const PLANT: &str = "MomentumPlant";

/// How downlinks share the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Downlink {
    /// Hours of a downlink.
    pub length_h: f64,
    /// Hours from one downlink to the next.
    pub every_h: f64,
}

impl Downlink {
    /// Its part of the time.
    pub(super) fn share(&self) -> f64 {
        if self.every_h > 0.0 { (self.length_h / self.every_h).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// Place of the Sun at which a degree is weighed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WeighedSun {
    pub angles_deg: Angles,
    /// Whether the attitude has it there at the start.
    pub is_at_start: bool,
}

impl WeighedSun {
    /// Sun on -Y, for an attitude that is not known.
    const AHEAD: Self = Self { angles_deg: [0.0; 2], is_at_start: false };

    /// Whether it stands on -Y to the digits that are shown.
    pub(super) fn is_ahead(&self) -> bool {
        self.angles_deg.iter().all(|angle_deg| angle_deg.abs() < 5e-4)
    }

    /// Returns its place in the attitude of MomentumPlant at the start; on -Y where that does not start by itself.
    fn of_attitude(fmu: &Fmu) -> Self {
        let at_start = || -> Result<Option<Angles>, fmi::Error> {
            let mut instance = started(fmu, "map", 0.0, &[])?;
            let (azimuth_rad, elevation_rad) =
                (instance.get_real("sun.azimuth")?, instance.get_real("sun.elevation")?);
            let is_waiting = instance.get_real("sun.distance")? == 0.0;
            Ok((!is_waiting).then_some([azimuth_rad, elevation_rad].map(f64::to_degrees)))
        };
        let found = at_start().ok().flatten();
        found.map_or(Self::AHEAD, |angles_deg| Self { angles_deg, is_at_start: true })
    }
}

/// A spacecraft ready to be mapped.
pub(super) struct MappedSpacecraft {
    pub name: String,
    pub lit: LitSpacecraft,
    /// Greatest azimuth and elevation of the Sun keep-in zone; `None` without one.
    pub zone_rad: Option<[f64; 2]>,
    pub downlink: Downlink,
    /// Panels that MomentumPlant leaves out, which DisturbanceTorque cannot.
    pub panels_left_out: bool,
    pub threshold_n_m_s: [f64; 3],
    pub sun: WeighedSun,
    // The FMU's folder, as long as it is in use.
    _folder: Scratch,
}

/// A file's text, the name that problems are reported by, and the FMU whose library reads it.
fn given(arguments: &Map) -> Result<(String, String, Source), Failure> {
    let file = arguments.spacecraft.display().to_string();
    let is_toml = arguments.spacecraft.extension().is_some_and(|it| it.eq_ignore_ascii_case("toml"));
    if is_toml {
        let text = FileKind::Spacecraft.read(&arguments.spacecraft)?;
        return Ok((file, text, Source::of_template(open_template(&arguments.template())?)?));
    }
    if arguments.template.is_some() {
        return Err(format!("{file}: found no TOML file, allowed: one: see --template").into());
    }
    let fmu = Fmu::open(&arguments.spacecraft)?;
    let model = model_of(&fmu, fmu.binary()?.as_ref())?;
    let setup = fmu.binary()?.models()?.into_iter().find(|it| it.model == model).and_then(|it| it.setup_file);
    let setup = setup.ok_or_else(|| format!("{file}: {model} holds no spacecraft"))?;
    let text = files::read_text(&fmu.folder().join("resources").join(&setup))?;
    Ok((format!("{file}: {setup}"), text, Source::of_template(fmu)?))
}

impl MappedSpacecraft {
    /// Reads the file and makes an FMU of it in a temporary folder.
    pub(super) fn open(arguments: &Map) -> Result<Self, Failure> {
        let (file, mut text, source) = given(arguments)?;
        if Spacecraft::from_toml(&file, &text).is_err() && Spinner::parse(&file, &text).is_ok() {
            let allowed = "a three-axis spacecraft: the torque on a spinner is that of `heliotorque run`";
            return Err(format!("{file}: found a spinner, allowed: {allowed}").into());
        }
        let describe = |model: &str, text: Option<&str>| -> Result<Description, Failure> {
            let file = text.map(|_| file.as_str());
            Ok(description(&source.binary().describe(model, file, text)?)?)
        };
        for set in &arguments.set {
            let (torque, simulated) = (describe(MODEL, Some(&text))?, describe(PLANT, Some(&text))?);
            // A name that neither has is reported as one of DisturbanceTorque.
            let name = set.split_once('=').map_or(set.as_str(), |(name, _)| name);
            let is_known = |description| fmi::select(description, name).is_ok();
            let (model, description) = if !is_known(&torque) && is_known(&simulated) {
                (PLANT, &simulated)
            } else {
                (MODEL, &torque)
            };
            text = with_values(&text, START, model, description, &[(format!("--set {set}"), set.clone())])?;
        }
        let described = source.binary().describe(MODEL, Some(&file), Some(&text))?;
        let simulated = describe(PLANT, Some(&text))?;
        let (fmu, folder) = unpacked(&source, MODEL, &described, &text)?;
        let sun = match arguments.sun {
            Some(angles_rad) => {
                WeighedSun { angles_deg: angles_rad.map(f64::to_degrees), is_at_start: false }
            }
            None => {
                let described = source.binary().describe(PLANT, Some(&file), Some(&text))?;
                // The folder stays until the Sun is found.
                let (plant, _folder) = unpacked(&source, PLANT, &described, &text)?;
                WeighedSun::of_attitude(&plant)
            }
        };
        let spacecraft = Spacecraft::from_toml(&file, &text).map_err(|error| error.to_string())?;
        let default = describe(MODEL, None)?;
        let distance_m = match arguments.distance {
            Some(distance_au) => distance_au * AU_M,
            None => distance_m(fmu.description(), &simulated, &default),
        };
        let panels = turned(
            (spacecraft.panels, &spacecraft.articulation),
            &fmu,
            &simulated,
            (arguments.panel_offset, distance_m),
        );
        if arguments.panel_offset.is_some()
            && !panels.iter().any(|it| matches!(it.rule, Rule::SunOffset { .. }))
        {
            return Err(format!("--panel-offset: {file} has no panel held by Sun offset").into());
        }
        let [azimuth_rad, elevation_rad] =
            ["keepIn.azimuth", "keepIn.elevation"].map(|name| real(&simulated, name));
        let simulated_zone_rad =
            azimuth_rad.zip(elevation_rad).map(|(azimuth_rad, elevation_rad)| [azimuth_rad, elevation_rad]);
        // Everywhere is what the plant makes of a file without a zone.
        let everywhere_rad = [core::f64::consts::PI, core::f64::consts::FRAC_PI_2];
        let zone_rad = arguments.zone.or(simulated_zone_rad).filter(|zone_rad| *zone_rad != everywhere_rad);
        if zone_rad.is_some_and(|zone_rad| zone_rad.contains(&0.0)) {
            let what = "keepIn.azimuth, keepIn.elevation: found 0 deg, allowed: more";
            return Err(format!("{file}: {what}: see --set and --zone").into());
        }
        Ok(Self {
            name: spacecraft.name,
            lit: LitSpacecraft { fmu, panels, distance_m, source: arguments.source.name() },
            zone_rad,
            downlink: downlink(&simulated, spacecraft.downlinks),
            panels_left_out: panels_left_out(&simulated),
            threshold_n_m_s: [1, 2, 3]
                .map(|axis| real(&simulated, &format!("dump.threshold[{axis}]")).unwrap_or(f64::INFINITY)),
            sun,
            _folder: folder,
        })
    }
}

/// The FMU of a model in a temporary folder: description, library, spacecraft.
fn unpacked(
    source: &Source,
    model: &str,
    described: &Described,
    text: &str,
) -> Result<(Fmu, Scratch), Failure> {
    let mut entries = Entries::default();
    entries.add("modelDescription.xml", described.xml.clone().into_bytes())?;
    if let Some(name) = &described.setup_file {
        entries.add(&format!("resources/{name}"), text.as_bytes().to_vec())?;
    }
    source.add_libraries(&mut entries, model)?;
    let folder = Scratch::new()?;
    entries.write_below(folder.path())?;
    Ok((Fmu::open(folder.path())?, folder))
}

/// The panels with the angles that MomentumPlant would give them.
fn turned(
    (panels, corridor): (Vec<Panel>, &Articulation),
    fmu: &Fmu,
    simulated: &Description,
    (offset_rad, distance_m): (Option<f64>, f64),
) -> Vec<TurnedPanels> {
    let rule = |number: usize, panel: &Panel| {
        let name = |last: &str| format!("panel[{number}].{last}");
        let control = match item(simulated, &name("control")) {
            Some("sunOffset") => PanelControl::SunOffset,
            Some("timeline") => PanelControl::Timeline,
            Some("distance") => PanelControl::Distance,
            Some(_) => PanelControl::Angle,
            None => panel.control,
        };
        let own_rad = match control {
            PanelControl::SunOffset | PanelControl::Timeline => {
                real(simulated, &name("sunOffset")).unwrap_or(panel.sun_offset_rad)
            }
            PanelControl::Distance => {
                let suns = real(simulated, "articulation.targetSuns").unwrap_or(corridor.target_suns);
                offset_for_suns(suns, distance_m)
            }
            PanelControl::Angle | PanelControl::Command => {
                return Rule::Angle(real(fmu.description(), &name("angle")).unwrap_or(panel.angle_rad));
            }
        };
        let tilt_sign = match item(simulated, &name("tilt")) {
            Some("positive") => 1.0,
            Some("negative") => -1.0,
            _ => panel.tilt_sign,
        };
        Rule::SunOffset { offset_rad: offset_rad.unwrap_or(own_rad), tilt_sign }
    };
    let numbered = panels.into_iter().enumerate();
    numbered.map(|(index, panel)| TurnedPanels { rule: rule(index + 1, &panel), panel }).collect()
}

fn panels_left_out(simulated: &Description) -> bool {
    let enabled = |number: usize| start_of(simulated, &format!("panel[{number}].enabled"));
    (1..).map_while(enabled).any(|enabled| enabled == Value::Boolean(false))
}

/// Distance of the Sun by the file, otherwise the mean distance of the body it orbits.
fn distance_m(described: &Description, simulated: &Description, default: &Description) -> f64 {
    let sun_m = |description: &Description| {
        Vector3::from(
            [1, 2, 3].map(|axis| real(description, &format!("sun.positionBody[{axis}]")).unwrap_or(0.0)),
        )
    };
    let given_m = sun_m(described);
    if given_m != sun_m(default) && given_m.norm() > 0.0 {
        return given_m.norm();
    }
    match center(simulated) {
        Body::Sun => real(simulated, "orbit.semiMajorAxis").map_or(AU_M, f64::abs),
        Body::Custom => real(simulated, "ephemeris.semiMajorAxis").unwrap_or(AU_M),
        planet => planet.data().orbit_semi_major_axis_m,
    }
}

fn center(simulated: &Description) -> Body {
    let named = item(simulated, "orbit.center").unwrap_or("mercury");
    let item = Body::ITEMS.iter().find(|item| item.name == named);
    item.map_or(Body::Mercury, |item| item.variant)
}

fn downlink(simulated: &Description, windows: Option<DownlinkWindows>) -> Downlink {
    let [start_s, end_s] =
        ["guided.downlinkStart", "guided.downlinkEnd"].map(|name| real(simulated, name).unwrap_or(0.0));
    let every = start_of(simulated, "guided.downlinkEvery").map_or(0.0, |value| value.to_f64());
    let axis_m = real(simulated, "orbit.semiMajorAxis").unwrap_or(0.0);
    let gm_m3_s2 = match center(simulated) {
        Body::Sun => Body::Sun.data().gm_m3_s2,
        _ => real(simulated, "planet.gravitationalParameter").unwrap_or(0.0),
    };
    let period_s = core::f64::consts::TAU * (axis_m.powi(3) / gm_m3_s2).sqrt();
    let in_orbit_s =
        |time: TimeAfterPeriapsis, start_s| time.period_share().map_or(start_s, |it| it * period_s);
    let [start_s, end_s] = match windows {
        Some(windows) => [in_orbit_s(windows.start, start_s), in_orbit_s(windows.stop, end_s)],
        None => [start_s, end_s],
    };
    Downlink { length_h: (end_s - start_s).max(0.0) / 3600.0, every_h: every * period_s / 3600.0 }
}

fn start_of(description: &Description, name: &str) -> Option<Value> {
    variables::start(description, &[], name)
}

fn real(description: &Description, name: &str) -> Option<f64> {
    start_of(description, name).map(|value| value.to_f64())
}

fn item<'a>(description: &'a Description, name: &str) -> Option<&'a str> {
    variables::item(description, &[], name)
}
