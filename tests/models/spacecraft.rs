//! Spacecraft files that several tests simulate: everything acts on everything, or hardly anything does.

/// Surfaces that shadow one another, with heat stored and not, each face reported; two wheels only.
pub(crate) const RADIATING: &str = r#"
name = "Warm"
per_plate_outputs = true
[mass_properties]
mass_kg = 100
center_of_mass_m = [0.1, 0.05, -0.2]
inertia_kg_m2 = [[10, 0.5, -0.2], [0.5, 12, 0.3], [-0.2, 0.3, 15]]
[optics.white]
specular = 0.2
diffuse = 0.5
emissivity = 0.8
infrared_absorptivity = 0.7
[[plates]]
name = "shade"
polygon_m = [[-0.5, -1.2, -0.4], [0.6, -1.2, -0.4], [0.5, -1.2, 0.6], [-0.4, -1.2, 0.5]]
normal = [0.0, -1.0, 0.0]
optics = "white"
rear_optics = "white"
[[plates]]
name = "radiator"
polygon_m = [[-1.0, 0.3, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-1.0, 0.3, 1.0]]
normal = [-0.1483404, -0.9889364, 0.0]
optics = "white"
thermal.heat_capacity_j_m2_k = 4000.0
[[plates]]
name = "far"
area_m2 = 0.7
center_m = [0.3, 0.4, 1.5]
normal = [0.6, 0.48, 0.64]
optics = "white"
[[panels]]
name = "inner"
polygon_m = [[0.2, -0.2, -1.0], [1.6, -0.2, -1.0], [1.6, -0.2, 1.0], [0.2, -0.2, 1.0]]
axis = [1.0, 0.0, 0.0]
zero_normal = [0.0, -1.0, 0.0]
optics = "white"
rear_optics = "white"
control = "angle"
thermal.conduction = { conductance_w_m2_k = 10.0, radiative_exchange = 0.1 }
thermal.heat_capacity_j_m2_k = 2000.0
[[panels]]
name = "outer"
area_m2 = 1.5
center_m = [-3.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
zero_normal = [0.0, -1.0, 0.0]
optics = "white"
control = "sun_offset"
sun_offset_deg = 30.0
[[wheels]]
axis = [1.0, 0.0, 0.0]
capacity_n_m_s = 8.0
[[wheels]]
axis = [0.0, 1.0, 0.0]
capacity_n_m_s = 4.0
"#;

/// A turned shade in both shapes, a map of the planet, three wheels along skew axes; no surface stores heat.
pub(crate) const ALL: &str = r#"
name = "All"
[mass_properties]
mass_kg = 200
center_of_mass_m = [0.1, 0.05, -0.2]
inertia_kg_m2 = [[100, 5, -2], [5, 120, 3], [-2, 3, 150]]
[planet_map]
diffuse_reflectivity = [[0.1, 0.2, 0.3, 0.4], [0.5, 0.6, 0.3, 0.2]]
emissivity = [[0.9, 0.8, 0.7, 0.6], [0.5, 0.6, 0.7, 0.8]]
temperature_k = [[100, 400, 600, 300], [120, 380, 650, 310]]
[optics.cloth]
specular = 0.2
diffuse = 0.4
[sunshade]
model = "plates"
rotation_deg = [4.0, 7.0, -3.0]
[sunshade.cylinder]
radius_m = 0.991
height_m = 2.489
subtended_angle_deg = 122.0
optics = "cloth"
[[sunshade.plates]]
name = "left"
area_m2 = 1.3
center_m = [0.7, -0.6, 0.1]
normal = [0.6, -0.8, 0.0]
optics = "cloth"
[[sunshade.plates]]
name = "right"
area_m2 = 1.1
center_m = [-0.6, -0.7, 0.0]
normal = [-0.48, -0.8, 0.36]
optics = "cloth"
[[plates]]
name = "bus"
area_m2 = 0.9
center_m = [0.2, 0.6, 0.4]
normal = [0.36, 0.8, 0.48]
optics = "cloth"
[[panels]]
name = "wing"
area_m2 = 2.0
center_m = [1.9, 0.1, 0.2]
axis = [0.8, 0.6, 0.0]
zero_normal = [0.6, -0.8, 0.0]
optics = "cloth"
rear_optics = "cloth"
[[wheels]]
axis = [0.8, 0.6, 0.0]
capacity_n_m_s = 8.0
[[wheels]]
axis = [0.0, 0.6, 0.8]
capacity_n_m_s = 4.0
[[wheels]]
axis = [-0.6, 0.0, 0.8]
capacity_n_m_s = 12.0
[[flexible_modes]]
frequency_hz = 0.8
coupling_sqrt_kg_m = [3.0, -2.0, 4.0]
[[slosh]]
mass_kg = 20.0
length_m = 0.3
pivot_m = [0.3, 0.1, 0.2]
axis = [0.6, 0.0, 0.8]
"#;

/// A body of simple numbers with a tank in its middle.
pub(crate) const SIMPLE: &str = r#"
name = "simple"
[mass_properties]
mass_kg = 500.0
center_of_mass_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [[200.0, 0.0, 0.0], [0.0, 300.0, 0.0], [0.0, 0.0, 400.0]]
[optics.black]
specular = 0.0
diffuse = 0.0
[[plates]]
area_m2 = 1.0
center_m = [0.0, 0.0, 0.0]
normal = [0.0, -1.0, 0.0]
optics = "black"
[[tanks]]
position_m = [0.0, 0.0, 0.0]
propellant_kg = 50.0
"#;

/// Specific impulse of the thrusters here, with 220 s.
pub(crate) const EXHAUST_M_S: f64 = 220.0 * 9.80665;

pub(crate) fn thruster(position: [f64; 3], direction: [f64; 3], force_n: f64, more: &str) -> String {
    format!(
        "[[thrusters]]\nposition_m = {position:?}\ndirection = {direction:?}\nforce_n = {force_n:?}\n\
         specific_impulse_s = 220.0\n{more}\n"
    )
}

/// Couples each way about all axes: twelve thrusters of 5 N, arms of 1 m.
pub(crate) fn couples(more: &str) -> String {
    let mut text = String::new();
    for axis in 0..3 {
        for sense in [1.0, -1.0] {
            for side in [1.0, -1.0] {
                let (mut at, mut force) = ([0.0; 3], [0.0; 3]);
                at[(axis + 1) % 3] = side;
                force[(axis + 2) % 3] = side * sense;
                text += &thruster(at, force, 5.0, more);
            }
        }
    }
    text
}
