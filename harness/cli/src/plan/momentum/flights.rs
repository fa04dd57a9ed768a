//! Flights of a planned mission through its FMU: as it is, and by the timeline of a plan.

use std::{error::Error, path::Path, sync::atomic::AtomicBool};

use files::Scratch;
use loader::{Fmu, InputTable, Options, Recording, Value};
use nalgebra::{Matrix3, Rotation3, Vector3};
use physics::{
    attitude::Attitude,
    environment::dates,
    guidance::timeline::{Timeline, simulation_time_s},
    plant::{LightSource, SunLight},
    spacecraft::{Articulation, MassProperties, Spacecraft, SunshadeModel},
};
use planner::momentum::{
    simulated::{FlightRow, SimulatedFlight},
    torque::SunlitSpacecraft,
};

use crate::{
    assembly::spacecraft_of,
    interrupt,
    mission::{Inputs, Mission, SpacecraftSource},
    run::{Run, Settings, Simulated, Subject},
    values,
    variables::{item, selected, start},
};

/// Why something could not be done.
pub(super) type Failure = Box<dyn Error>;

/// The model that is planned.
const MODEL: &str = "MomentumPlant";
/// Communication step, in s; steps change nothing in what is simulated.
const STEP_S: f64 = 3600.0;
/// A component of momentum that is never reached.
const NEVER_N_M_S: f64 = 1e9;
/// What a plan reads of a flight.
const RECORDED: [&str; 9] = [
    "position",
    "sun.positionInertial",
    "earth.positionInertial",
    "sun.litFraction",
    "attitude.q",
    "torque.total",
    "torque.solar",
    "momentum.inertial",
    "dump.count",
];

/// By which thresholds a flight dumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Thresholds {
    /// The mission's.
    Own,
    /// None.
    Never,
}

/// A mission that can be simulated.
pub(super) struct SimulatedMission {
    pub mission: Mission,
    pub fmu: Fmu,
    pub sets: Vec<(String, Value)>,
    inputs: Option<InputTable>,
    pub start_s: f64,
    pub stop_s: f64,
    /// Epoch of time 0 in s past J2000 TDB, where the mission begins at a date.
    pub zero_epoch_s: Option<f64>,
    // The FMU's folder, as long as it is in use.
    _folder: Option<Scratch>,
}

impl SimulatedMission {
    /// Opens a mission; values that win over its own as for `--set`.
    pub(super) fn open(file: &Path, template: Option<&Path>, set: &[String]) -> Result<Self, Failure> {
        let run = Run {
            fmu: file.to_owned(),
            template: template.map(Path::to_owned),
            set: set.to_vec(),
            ..Run::default()
        };
        let simulated = Simulated::of(&run)?;
        let Some(mission) = simulated.mission.clone() else {
            return Err(format!("{}: found no mission, allowed: one (.toml)", file.display()).into());
        };
        if let SpacecraftSource::Fmu(fmu) = &mission.spacecraft_source {
            let found =
                format!("found `fmu = {:?}`, which takes no other timeline", fmu.display().to_string());
            let allowed = "allowed: spacecraft or model, of which the plan's FMU is packed";
            return Err(format!("{}: {found}, {allowed}", file.display()).into());
        }
        if let Some(Inputs::Rows(rows)) = &mission.inputs
            && let Some(at) = rows.iter().find(|at| at.it.0.starts_with("downlink."))
        {
            let what = "found an input that the plan commands, allowed: none of downlink.*: inputs rule over timelines";
            return Err(mission.problem(at, what).into());
        }
        let (subject, folder) = simulated.open()?;
        let settings = Settings::of(&subject, &simulated, None)?;
        let Subject::Fmu(fmu) = subject else {
            return Err(format!("{}: found a system, allowed: {MODEL}", file.display()).into());
        };
        check(file, &fmu, &settings.sets)?;
        Ok(Self {
            mission,
            fmu,
            start_s: settings.times.start_s,
            stop_s: settings.times.stop_s,
            zero_epoch_s: simulated.zero_epoch_s(settings.times.start_s),
            sets: settings.sets,
            inputs: settings.inputs,
            _folder: folder,
        })
    }

    /// Its time of an instant, in s; `None` for a date where the mission has none.
    pub(super) fn time_s(&self, instant: values::Instant) -> Option<f64> {
        match instant {
            values::Instant::Time(time_s) => Some(time_s),
            values::Instant::Epoch(epoch_s) => self.zero_epoch_s.map(|zero_s| dates::span_s(zero_s, epoch_s)),
        }
    }

    /// The spacecraft that its FMU holds.
    pub(super) fn spacecraft(&self) -> Result<Spacecraft, Failure> {
        spacecraft_of(&self.fmu)
    }

    /// The text of its timeline and what it says; `None` without one.
    pub(super) fn timeline(&self, spacecraft: &Spacecraft) -> Result<Option<(String, Timeline)>, Failure> {
        let SpacecraftSource::Files { timeline: Some(path), .. } = &self.mission.spacecraft_source else {
            return Ok(None);
        };
        let text = files::read_text(path)?;
        let shown = path.display().to_string();
        let timeline = Timeline::of_plant(&shown, &text, spacecraft).map_err(|error| error.to_string())?;
        Ok(Some((text, timeline)))
    }

    /// What turns the clock of a timeline into times of the flight, in s to be subtracted.
    pub(super) fn clock_minus_time_s(&self, timeline: &Timeline) -> f64 {
        let zero_s = self.zero_epoch_s.unwrap_or_else(|| self.real("start.epoch") - self.start_s);
        timeline.clock_minus_time_s(zero_s)
    }

    /// A Real as it is set.
    pub(super) fn real(&self, name: &str) -> f64 {
        start(self.fmu.description(), &self.sets, name).map_or(f64::NAN, |value| value.to_f64())
    }

    /// An option as it is set.
    pub(super) fn item(&self, name: &str) -> Option<&str> {
        item(self.fmu.description(), &self.sets, name)
    }

    pub(super) fn is_true(&self, name: &str) -> bool {
        start(self.fmu.description(), &self.sets, name) == Some(Value::Boolean(true))
    }

    pub(super) fn vector(&self, name: &str) -> Vector3<f64> {
        Vector3::from([1, 2, 3].map(|axis| self.real(&format!("{name}[{axis}]"))))
    }

    /// The least `dump.threshold`, in N m s.
    pub(super) fn least_threshold_n_m_s(&self) -> f64 {
        self.vector("dump.threshold").min()
    }

    /// The corridor of the light on the cells.
    pub(super) fn corridor(&self) -> Articulation {
        Articulation {
            min_suns: self.real("articulation.minimumSuns"),
            max_suns: self.real("articulation.maximumSuns"),
            target_suns: self.real("articulation.targetSuns"),
        }
    }

    /// Greatest azimuth and elevation that the keep-in zone allows, in rad.
    pub(super) fn zone_rad(&self) -> [f64; 2] {
        match self.is_true("keepIn.enabled") {
            true => [self.real("keepIn.azimuth"), self.real("keepIn.elevation")],
            false => [f64::INFINITY; 2],
        }
    }

    /// The spacecraft in sunlight with the mission's values, the centre of mass as it is at each time.
    pub(super) fn sunlit(&self, timeline: Option<&Timeline>) -> Result<SunlitSpacecraft, Failure> {
        let spacecraft = self.spacecraft()?;
        let shape = match self.item("sunshade.shape") {
            Some("plates") => Some(SunshadeModel::Plates),
            Some("cylinder") => Some(SunshadeModel::Cylinder),
            _ => None,
        };
        let source = match self.is_true("solar.fixedPressure") {
            true => LightSource::Fixed { pressure_pa: self.real("solar.pressure") },
            false => LightSource::Distance { flux_w_m2: self.real("solar.flux") },
        };
        let light = SunLight { source, scale: self.real("solar.scale") };
        let mut sunlit = SunlitSpacecraft::new(spacecraft, light, shape)?;
        let inertia =
            |row: usize, column: usize| self.real(&format!("spacecraft.inertia[{},{}]", row + 1, column + 1));
        sunlit.mass_at_zero = MassProperties {
            mass_kg: self.real("spacecraft.mass"),
            center_of_mass_body_m: self.vector("spacecraft.centerOfMass"),
            inertia_body_kg_m2: Matrix3::from_fn(inertia),
        };
        for (index, (enabled, sign)) in sunlit.panels.iter_mut().enumerate() {
            let name = |last: &str| format!("panel[{}].{last}", index + 1);
            *enabled = self.is_true(&name("enabled"));
            match self.item(&name("tilt")) {
                Some("positive") => *sign = 1.0,
                Some("negative") => *sign = -1.0,
                _ => {}
            }
        }
        if let Some(timeline) = timeline {
            let clock_minus_time_s = self.clock_minus_time_s(timeline);
            let moved = timeline.events().iter().filter_map(|event| {
                Some((simulation_time_s(event.at_s, clock_minus_time_s), event.center_of_mass_body_m?))
            });
            sunlit.centers_of_mass = moved.collect();
        }
        Ok(sunlit)
    }

    /// Simulates it.
    pub(super) fn simulate(
        &self,
        thresholds: Thresholds,
        seed: Option<u32>,
    ) -> Result<SimulatedFlight, Failure> {
        let description = self.fmu.description();
        let panels = (1..).map(|number| format!("panel[{number}].angleActual"));
        let panels = panels.take_while(|name| description.variables.iter().any(|it| it.name == *name));
        let panels: Vec<String> = panels.collect();
        let patterns: Vec<String> = RECORDED.iter().map(|name| (*name).to_owned()).collect();
        let patterns = [patterns, panels.clone()].concat();
        let mut sets = self.sets.clone();
        if thresholds == Thresholds::Never {
            let axes = 1..=3;
            sets.extend(axes.map(|axis| (format!("dump.threshold[{axis}]"), Value::Real(NEVER_N_M_S))));
        }
        if let Some(seed) = seed.and_then(|seed| i32::try_from(seed).ok()) {
            sets.push(("noise.seed".to_owned(), Value::Integer(seed)));
        }
        let cancel = AtomicBool::new(false);
        let mut reported = |_: f64| {
            cancel.store(interrupt::raised(), std::sync::atomic::Ordering::Relaxed);
        };
        let options = Options {
            start_s: Some(self.start_s),
            stop_s: Some(self.stop_s),
            step_s: Some(STEP_S.min((self.stop_s - self.start_s) / 8.0)),
            sets,
            inputs: self.inputs.as_ref(),
            record: Some(selected(description, &patterns, loader::select_outputs)?),
            apart: description.variables.iter().position(|it| it.name == "dump.count"),
            progress: Some(&mut reported),
            cancel: Some(&cancel),
            ..Options::default()
        };
        let recording =
            loader::simulate(&self.fmu, options).map_err(|error| loader::Error::chain(&error))?.recording;
        if interrupt::raised() {
            return Err("interrupted".into());
        }
        simulated(&recording, &panels)
    }
}

/// A plant that follows downlinks ideally, and chooses no places of the Sun itself.
fn check(file: &Path, fmu: &Fmu, sets: &[(String, Value)]) -> Result<(), Failure> {
    let description = fmu.description();
    let shown = file.display();
    if item(description, sets, "attitude.source").is_none() {
        let found = &description.model_name;
        return Err(
            format!("{shown}: model: found {found}, allowed: {MODEL}: a plan is for its missions").into()
        );
    }
    for (name, allowed) in
        [("attitude.source", "guided"), ("guided.phase", "cruise"), ("momentum.strategy", "dumpsOnly")]
    {
        let found = item(description, sets, name).unwrap_or("none");
        if found != allowed {
            return Err(format!("{shown}: {name}: found {found}, allowed: {allowed}, for a plan").into());
        }
    }
    Ok(())
}

/// The columns of a recording as rows of a flight.
fn simulated(recording: &Recording, panels: &[String]) -> Result<SimulatedFlight, Failure> {
    let column = |name: &str| -> Result<Vec<f64>, Failure> {
        Ok(recording.column(name).ok_or_else(|| format!("the FMU has no output {name}"))?.numbers())
    };
    let columns = |name: &str, count: usize| -> Result<Vec<Vec<f64>>, Failure> {
        (1..=count).map(|axis| column(&format!("{name}[{axis}]"))).collect()
    };
    let vector =
        |columns: &[Vec<f64>], row: usize| Vector3::new(columns[0][row], columns[1][row], columns[2][row]);
    let [position, sun, earth, total, solar, momentum] = [
        "position",
        "sun.positionInertial",
        "earth.positionInertial",
        "torque.total",
        "torque.solar",
        "momentum.inertial",
    ]
    .map(|name| columns(name, 3));
    let (position, sun, earth, total, solar, momentum) = (position?, sun?, earth?, total?, solar?, momentum?);
    let q = columns("attitude.q", 4)?;
    let (lit, dumps) = (column("sun.litFraction")?, column("dump.count")?);
    let angles = panels.iter().map(|name| column(name)).collect::<Result<Vec<_>, _>>()?;
    let attitude = |row: usize| -> Result<Rotation3<f64>, Failure> {
        Ok(Attitude::along_quaternion([0, 1, 2, 3].map(|part: usize| q[part][row]))?.inertial_from_body())
    };
    let rows = (0..recording.times_s.len()).map(|row| -> Result<FlightRow, Failure> {
        let inertial_from_body = attitude(row)?;
        let here = vector(&position, row);
        Ok(FlightRow {
            time_s: recording.times_s[row],
            to_sun_m: vector(&sun, row) - here,
            to_earth_m: vector(&earth, row) - here,
            lit_fraction: lit[row],
            inertial_from_body,
            panel_angles_rad: angles.iter().map(|column| column[row]).collect(),
            other_torque_n_m: inertial_from_body * (vector(&total, row) - vector(&solar, row)),
            momentum_n_m_s: vector(&momentum, row),
            dumps: dumps[row] as u32,
        })
    });
    let mut rows: Vec<FlightRow> = rows.collect::<Result<_, _>>()?;
    // Of two rows at one time the later counts.
    rows.reverse();
    rows.dedup_by(|next, kept| next.time_s >= kept.time_s);
    rows.reverse();
    Ok(SimulatedFlight { rows })
}
