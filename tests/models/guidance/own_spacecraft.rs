//! An own spacecraft, controlled and wired with Guidance: its instrument stays at nadir, it talks in its windows, it is never demoted.

use client::{NamedInstance, short_or_long};
use nalgebra::Vector3;

use super::super::disturbance_torque::instance;

const HOUR_S: f64 = 3600.0;
/// Items of `mode.active` and `pointing.scenario`.
const OPERATIONAL: i32 = 1;
const NADIR: i32 = 3;
const ORBIT_PHASE: i32 = 10;
/// Off the body axes.
const BORESIGHT: [f64; 3] = [0.28, 0.0, 0.96];

/// A bus with a panel, an instrument and wheels. Of its pointing it says nothing but `more`.
fn spacecraft(planet: &str, axis_km: f64, more: &str) -> String {
    format!(
        r#"
name = "Surveyor"
{more}
[mass_properties]
mass_kg = 450
center_of_mass_m = [0, 0, -0.02]
inertia_kg_m2 = [[260, 0, 0], [0, 310, 0], [0, 0, 180]]
[optics.mli]
specular = 0.3
diffuse = 0.2
[[boxes]]
name = "bus"
center_m = [0, 0, 0]
size_m = [1.2, 1.2, 1.6]
optics = "mli"
[[instruments]]
name = "camera"
boresight = {BORESIGHT:?}
[[wheels]]
name = "1"
axis = [0.577, 0.577, 0.577]
capacity_n_m_s = 20
[[wheels]]
name = "2"
axis = [-0.577, 0.577, 0.577]
capacity_n_m_s = 20
[[wheels]]
name = "3"
axis = [-0.577, -0.577, 0.577]
capacity_n_m_s = 20
[[wheels]]
name = "4"
axis = [0.577, -0.577, 0.577]
capacity_n_m_s = 20
[start.MomentumPlant]
"attitude.source" = "controlled"
"orbit.center" = "{planet}"
"orbit.semiMajorAxis" = "{axis_km} km"
"orbit.ascendingNode" = "40 deg"
"control.rate" = 10
[start.Guidance]
"target.planet" = "{planet}"
"#
    )
}

/// Plant and Guidance, each with what the other had at the step's begin.
struct Loop {
    plant: NamedInstance,
    guidance: NamedInstance,
}

impl Loop {
    fn begin(text: &str, scenario: i32) -> Self {
        let [mut plant, mut guidance] =
            ["MomentumPlant", "Guidance"].map(|model| instance(model, "surveyor", text));
        guidance.put_integer("pointing.scenario", scenario);
        guidance.put_integer("boresight.instrument", 1);
        for it in [&mut plant, &mut guidance] {
            let status = it.fmu.setup_experiment(0.0, None).max(it.fmu.enter_initialization_mode());
            it.ok("initialization", status);
        }
        let mut wired = Self { plant, guidance };
        // What one shows at the start follows from what the other does.
        wired.exchange();
        wired.exchange();
        for it in [&mut wired.plant, &mut wired.guidance] {
            let status = it.fmu.exit_initialization_mode();
            it.ok("initialization", status);
        }
        wired
    }

    fn exchange(&mut self) {
        let Self { plant, guidance } = self;
        let (kind, q, rate) =
            (guidance.integer("command.kind"), guidance.array("command.q"), guidance.vector("command.rate"));
        for name in ["position", "velocity", "estimate.rate", "sun.sensed"] {
            guidance.put_vector(name, plant.vector(name));
        }
        guidance.put_vector("estimate.q", plant.array::<4>("estimate.q"));
        for name in ["estimate.valid", "sun.sensedValid"] {
            guidance.put_boolean(name, plant.boolean(name));
        }
        plant.put_integer("command.kind", kind);
        plant.put_vector::<4>("command.q", q);
        plant.put_vector("command.rate", rate);
    }

    /// A second, after which it is still operational.
    fn step(&mut self) {
        self.exchange();
        let end_s = self.plant.time_s + 1.0;
        self.plant.step_to(end_s);
        self.guidance.step_to(end_s);
        let (mode, reason) = (self.guidance.integer("mode.active"), self.guidance.integer("mode.reason"));
        assert_eq!((mode, reason), (OPERATIONAL, 0), "at {end_s} s");
    }

    /// Angle of the true boresight off the planet's centre, in deg.
    fn off_nadir_deg(&mut self) -> f64 {
        let nadir = Vector3::from(self.plant.vector("planet.positionBody"));
        nadir.angle(&Vector3::from(BORESIGHT)).to_degrees()
    }
}

#[test]
fn nadir_pointing_holds_without_a_keep_in_zone() {
    for (planet, axis_km) in [("venus", 6551.8), ("earth", 6878.0), ("mars", 3796.0)] {
        let mut wired = Loop::begin(&spacecraft(planet, axis_km, ""), NADIR);
        let mut worst_deg = wired.off_nadir_deg();
        while wired.plant.time_s < short_or_long(3.5, 24.0) * HOUR_S {
            wired.step();
            worst_deg = worst_deg.max(wired.off_nadir_deg());
        }
        println!("{planet}: {worst_deg} deg off nadir");
        assert!(worst_deg < 0.01, "{planet}: {worst_deg} deg");
    }
}

#[test]
fn the_link_is_there_in_its_windows() {
    let windows = r#"
downlinks = { start = "20 %", stop = "70 %", every = 1 }
antennas = [
    { name = "front", azimuth_deg = [-90, 0], beam_deg = [4, 15] },
    { name = "back", azimuth_deg = [90, 180], beam_deg = [4, 15] },
]"#;
    for (planet, axis_km) in [("venus", 6551.8), ("earth", 6878.0), ("mars", 3796.0)] {
        let mut wired = Loop::begin(&spacecraft(planet, axis_km, windows), ORBIT_PHASE);
        let mut linked_s = 0.0;
        while wired.plant.time_s < 6.0 * HOUR_S {
            wired.step();
            linked_s += f64::from(u8::from(wired.guidance.boolean("link.available")));
        }
        println!("{planet}: {linked_s} s of link");
        // About the Earth the antennas change twice an orbit, and the body turns from one to the other.
        let least = if planet == "earth" { 0.3 } else { 0.45 };
        assert!(linked_s > least * wired.plant.time_s, "{planet}: {linked_s} s");
    }
}

/// The file's zone counts at the Earth too, unless the file limits its distance from the Sun.
#[test]
fn a_keep_in_zone_counts_up_to_the_files_distance() {
    for (distance, counts) in [("", true), (", distance_m = 1.2e11", false)] {
        let zone = format!("sun_keep_in = {{ azimuth_deg = 10, elevation_deg = 10{distance} }}");
        let mut guidance =
            instance("Guidance", "surveyor", &spacecraft("earth", 7000.0, &format!("{zone}\n")));
        guidance.put_integer("pointing.scenario", NADIR);
        guidance.put_vector("position", [7e6, 0.0, 0.0]);
        guidance.put_vector("velocity", [0.0, 7.5e3, 0.0]);
        guidance.begin(0.0);
        let mut is_applied = false;
        // All around an orbit in the equator nadir itself has the Sun outside of the zone somewhere.
        for step in 1..=36_u32 {
            let (sine, cosine) = (f64::from(step) * 10_f64.to_radians()).sin_cos();
            guidance.put_vector("position", [7e6 * cosine, 7e6 * sine, 0.0]);
            guidance.put_vector("velocity", [-7.5e3 * sine, 7.5e3 * cosine, 0.0]);
            guidance.step_to(f64::from(step));
            is_applied |= guidance.boolean("constraint.sunKeepIn");
        }
        assert_eq!(is_applied, counts, "{zone}");
    }
}
