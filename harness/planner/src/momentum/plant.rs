//! MomentumPlant as a plan needs it: its spacecraft in sunlight by the values that are set, and a recording as a flight.

use model_description::{Description, start_values, value::Value};
use nalgebra::{Matrix3, Rotation3, Vector3};
use physics::{
    attitude::Attitude,
    environment::CartesianState,
    momentum::Convention,
    plant::{LightSource, SunLight},
    refusal::Refusal,
    spacecraft::{MassProperties, MaterialValues, Spacecraft, SunshadeModel},
};

use super::{
    simulated::{FlightRow, Motion, SimulatedFlight},
    torque::SunlitSpacecraft,
};

/// Values of variables at the start of a flight.
#[derive(Clone, Copy, Debug)]
pub struct StartValues<'a> {
    /// Description of the plant.
    pub description: &'a Description,
    /// Values that are set.
    pub sets: &'a [(String, Value)],
}

impl<'a> StartValues<'a> {
    /// Value of a Real; not a number where there is none.
    pub fn real(&self, name: &str) -> f64 {
        start_values::start(self.description, self.sets, name).map_or(f64::NAN, |value| value.to_f64())
    }

    /// Value of a Real, or `other` where there is none.
    /// A number, or another one where there is none.
    pub fn real_or(&self, name: &str, other: f64) -> f64 {
        start_values::start(self.description, self.sets, name).map_or(other, |value| value.to_f64())
    }

    /// The name of an option's item.
    pub fn item(&self, name: &str) -> Option<&'a str> {
        start_values::item(self.description, self.sets, name)
    }

    /// Whether a Boolean is true.
    pub fn is_true(&self, name: &str) -> bool {
        start_values::start(self.description, self.sets, name) == Some(Value::Boolean(true))
    }

    /// Value of a vector.
    pub fn vector(&self, name: &str) -> Vector3<f64> {
        Vector3::from([1, 2, 3].map(|axis| self.real(&format!("{name}[{axis}]"))))
    }

    /// Greatest azimuth and elevation of the Sun that the keep-in zone allows, in rad.
    pub fn zone_rad(&self) -> [f64; 2] {
        match self.is_true("keepIn.enabled") {
            true => [self.real("keepIn.azimuth"), self.real("keepIn.elevation")],
            false => [f64::INFINITY; 2],
        }
    }
}

/// The spacecraft in sunlight with these values.
///
/// # Errors
/// A sunshade that is not there in this form.
pub fn sunlit(
    spacecraft: Spacecraft,
    values: &StartValues<'_>,
    convention: Convention,
) -> Result<SunlitSpacecraft, Refusal> {
    let shape = match values.item("sunshade.shape") {
        Some("plates") => Some(SunshadeModel::Plates),
        Some("cylinder") => Some(SunshadeModel::Cylinder),
        _ => None,
    };
    let source = match values.is_true("solar.fixedPressure") {
        true => LightSource::Fixed { pressure_pa: values.real("solar.pressure") },
        false => LightSource::Distance { flux_w_m2: values.real("solar.flux") },
    };
    let light = SunLight { source, scale: values.real("solar.scale") };
    let mut sunlit = SunlitSpacecraft::new(spacecraft, light, shape)?;
    sunlit.convention = convention;
    let inertia =
        |row: usize, column: usize| values.real(&format!("spacecraft.inertia[{},{}]", row + 1, column + 1));
    sunlit.current_mass_panels_stowed = MassProperties {
        mass_kg: values.real("spacecraft.mass"),
        center_of_mass_body_m: values.vector("spacecraft.centerOfMass"),
        inertia_body_kg_m2: Matrix3::from_fn(inertia),
    };
    for (place, named) in sunlit.spacecraft.materials.clone().iter().enumerate() {
        let own = named.values();
        let set = |last: &str, own: f64| values.real_or(&format!("optics.{}.{last}", named.name), own);
        let (specular, diffuse) = (set("specular", own.specular), set("diffuse", own.diffuse));
        let reflecting = MaterialValues { specular, diffuse, ..own };
        // A flight with others is refused by the FMU.
        if let Ok(material) = named.with(&reflecting) {
            sunlit.set_material(place, &material);
        }
    }
    for (index, panel) in sunlit.panels.iter_mut().enumerate() {
        let name = |last: &str| format!("panel[{}].{last}", index + 1);
        let follows = values.item(&name("control")) == Some("distance");
        panel.followed_suns = follows.then(|| values.real("articulation.targetSuns"));
        panel.is_enabled = values.is_true(&name("enabled"));
        panel.tilt.bias_rad = values.real_or(&name("angleBias"), 0.0);
        match values.item(&name("tilt")) {
            Some("positive") => panel.tilt.sign = 1.0,
            Some("negative") => panel.tilt.sign = -1.0,
            _ => {}
        }
    }
    Ok(sunlit)
}

/// Variables that a flight is read from, beside the angle of every panel ([`panel`]); the momentum is the last.
pub fn recorded(convention: Convention) -> [&'static str; 10] {
    let momentum = match convention {
        Convention::Inertial => "momentum.inertial",
        Convention::BodyIntegral => "momentum.body",
    };
    [
        "position",
        "sun.positionInertial",
        "earth.positionInertial",
        "sun.litFraction",
        "attitude.q",
        "torque.total",
        "torque.solar",
        "dump.count",
        "downlink.active",
        momentum,
    ]
}

/// Variables recorded beside these where the motion counts: of a flight to an encounter.
pub const RECORDED_MOTION: [&str; 7] = [
    "velocity",
    "sun.velocityInertial",
    "encounter.position",
    "encounter.velocity",
    "force.solar",
    "force.thermal",
    "mass",
];

/// The variable with the angle of a panel, from 0.
pub fn panel(number: usize) -> String {
    format!("panel[{}].angleActual", number + 1)
}

/// A recording as a flight, with its motion where it has [`RECORDED_MOTION`]; `column` gives the values of a variable, a flag as 1
/// or 0.
///
/// # Errors
/// A column that is not there, a quaternion that is none.
pub fn flight(
    times_s: &[f64],
    column: &dyn Fn(&str) -> Option<Vec<f64>>,
    (panels, convention): (usize, Convention),
) -> Result<SimulatedFlight, String> {
    let column = |name: &str| column(name).ok_or_else(|| format!("the FMU has no output {name}"));
    let columns = |name: &str, count: usize| -> Result<Vec<Vec<f64>>, String> {
        (1..=count).map(|axis| column(&format!("{name}[{axis}]"))).collect()
    };
    let vector =
        |columns: &[Vec<f64>], row: usize| Vector3::new(columns[0][row], columns[1][row], columns[2][row]);
    let [position, sun, earth, lit, q, total, solar, dumps, downlink, momentum] = recorded(convention);
    let [position, sun, earth, total, solar, momentum] =
        [position, sun, earth, total, solar, momentum].map(|name| columns(name, 3));
    let (position, sun, earth, total, solar, momentum) = (position?, sun?, earth?, total?, solar?, momentum?);
    let q = columns(q, 4)?;
    let (lit, dumps, downlink) = (column(lit)?, column(dumps)?, column(downlink)?);
    let motion = match column("velocity[1]") {
        Ok(_) => {
            let [velocity, sun_velocity, body, body_velocity, light, heat, mass] = RECORDED_MOTION;
            let names = [velocity, sun_velocity, body, body_velocity, light, heat];
            let of = names.map(|name| columns(name, 3)).into_iter().collect::<Result<Vec<_>, _>>()?;
            Some((of, column(mass)?))
        }
        Err(_) => None,
    };
    let motion_at = |row: usize, inertial_from_body: &Rotation3<f64>| {
        let (columns, mass) = motion.as_ref()?;
        let at = |index: usize| vector(&columns[index], row);
        let sun = CartesianState { position_m: vector(&sun, row), velocity_m_s: at(1) };
        let here = CartesianState { position_m: vector(&position, row), velocity_m_s: at(0) };
        let body = CartesianState { position_m: at(2), velocity_m_s: at(3) };
        Some(Motion {
            from_sun: here - sun,
            body_from_sun: body - sun,
            mass_kg: mass[row],
            light_n: inertial_from_body * (at(4) + at(5)),
        })
    };
    let angles = (0..panels).map(|number| column(&panel(number))).collect::<Result<Vec<_>, _>>()?;
    let attitude = |row: usize| -> Result<Rotation3<f64>, String> {
        let q = [0, 1, 2, 3].map(|part: usize| q[part][row]);
        Ok(Attitude::along_quaternion(q).map_err(|error| error.to_string())?.inertial_from_body())
    };
    let rows = (0..times_s.len()).map(|row| -> Result<FlightRow, String> {
        let inertial_from_body = attitude(row)?;
        let here = vector(&position, row);
        let other_body_n_m = vector(&total, row) - vector(&solar, row);
        Ok(FlightRow {
            time_s: times_s[row],
            to_sun_m: vector(&sun, row) - here,
            to_earth_m: vector(&earth, row) - here,
            lit_fraction: lit[row],
            inertial_from_body,
            panel_angles_rad: angles.iter().map(|column| column[row]).collect(),
            other_torque_n_m: match convention {
                Convention::Inertial => inertial_from_body * other_body_n_m,
                Convention::BodyIntegral => other_body_n_m,
            },
            momentum_n_m_s: vector(&momentum, row),
            dumps: dumps[row] as u32,
            downlink: downlink[row] != 0.0,
            motion: motion_at(row, &inertial_from_body),
        })
    });
    let mut rows: Vec<FlightRow> = rows.collect::<Result<_, _>>()?;
    // Of two rows at one time the later counts.
    rows.reverse();
    rows.dedup_by(|next, kept| next.time_s >= kept.time_s);
    rows.reverse();
    Ok(SimulatedFlight { rows, ..SimulatedFlight::default() })
}
