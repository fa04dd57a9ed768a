//! Table of effects: what acts on a spacecraft, one row each.

/// At which times the load of an effect is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grid {
    /// At the nodes of segments of light and heat, which cost most.
    Light,
    /// Wherever it is needed, by a law in closed form; of a body that moves by torque on the disturbance grid, as light is.
    Disturbance,
    /// The same, but of a body that moves by torque by its attitude at every time, in a field on the disturbance grid.
    Field,
    /// With the motion: no disturbance, but applied from outside or by the spacecraft itself.
    Motion,
    /// The same, by parts that move in a body that moves by torque.
    MovingParts,
}

/// Switch of effects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Switch {
    /// Light of the planet.
    PlanetLight,
    /// Recoil of the heat the spacecraft radiates.
    Recoil,
    /// Gravity gradient.
    GravityGradient,
    /// Air.
    Aerodynamics,
    /// Magnetic field.
    Magnetics,
}

/// Writer of a row: it alone computes the load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Writer {
    /// The plant's source of this name.
    Source(&'static str),
    /// Motion of rotors out of balance.
    Rotors,
    /// Motion of propellant that swings.
    Propellant,
}

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectRow {
    /// Name under which loads and momentum are reported, in lower camel case.
    pub name: &'static str,
    /// Description in a sentence.
    pub about: &'static str,
    /// Switch of the effect; without one it always acts.
    pub switch: Option<Switch>,
    /// At which times it is computed.
    pub grid: Grid,
    /// Whether it exerts force beside torque.
    pub exerts_force: bool,
    /// Whether what it does to the momentum is kept apart from dump to dump.
    pub momentum_apart: bool,
    /// Typical change of momentum from dump to dump, in N m s.
    pub usual_momentum_n_m_s: f64,
    /// Writer.
    pub writer: Writer,
}

impl EffectRow {
    /// Its usual torque in N m: momentum is gathered over hours.
    pub fn usual_torque_n_m(&self) -> f64 {
        self.usual_momentum_n_m_s / 1e4
    }

    /// Its usual force in N, at an arm of 0.1 m.
    pub fn usual_force_n(&self) -> f64 {
        self.usual_momentum_n_m_s / 1e3
    }
}

macro_rules! effects {
    ($($effect:ident: $name:literal, $about:literal, $switch:expr, $grid:ident, $force:literal, $apart:literal, $usual:literal, $writer:expr;)+) => {
        /// An effect that exerts force or torque: a row of the table.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Effect {
            $(#[doc = $about] $effect,)+
        }

        impl Effect {
            /// All of them, in the order in which they are added up.
            pub const ALL: [Self; [$(Self::$effect),+].len()] = [$(Self::$effect),+];

            /// Its row.
            pub const fn row(self) -> &'static EffectRow {
                match self {
                    $(Self::$effect => &EffectRow {
                        name: $name,
                        about: $about,
                        switch: $switch,
                        grid: Grid::$grid,
                        exerts_force: $force,
                        momentum_apart: $apart,
                        usual_momentum_n_m_s: $usual,
                        writer: $writer,
                    },)+
                }
            }
        }
    };
}

effects! {
    // name, what it is, switch, grid, whether it exerts force, whether its momentum is kept apart, which usually is (N m s), writer
    Solar: "solar", "Direct sunlight.", None, Light, true, true, 1e-1, Writer::Source("sunlight");
    Albedo: "albedo", "Sunlight reflected by the planet.", Some(Switch::PlanetLight), Light, true, true, 1e-2, Writer::Source("sunlight");
    Infrared: "infrared", "Infrared light of the planet.", Some(Switch::PlanetLight), Light, true, true, 1e-2, Writer::Source("sunlight");
    Thermal: "thermal", "Recoil of the heat the spacecraft radiates.", Some(Switch::Recoil), Light, true, true, 1e-2, Writer::Source("sunlight");
    GravityGradient: "gravityGradient", "Gravity gradient of the planet.", Some(Switch::GravityGradient), Disturbance, false, true, 1e-1, Writer::Source("gravity_gradient");
    Aerodynamic: "aerodynamic", "Air on the spacecraft's surfaces.", Some(Switch::Aerodynamics), Disturbance, true, true, 1e-1, Writer::Source("air");
    Magnetic: "magnetic", "The residual dipole in the planet's magnetic field.", Some(Switch::Magnetics), Field, false, true, 1e-2, Writer::Source("magnetic");
    Applied: "applied", "What was applied from outside.", None, Motion, true, true, 1e-1, Writer::Source("applied");
    Thrusters: "thruster", "The spacecraft's own thrusters.", None, Motion, true, false, 1.0, Writer::Source("thrusters");
    Imbalance: "imbalance", "Rotors out of balance, in controlled and free flight.", None, MovingParts, true, true, 1e-2, Writer::Rotors;
    Slosh: "slosh", "Propellant that swings under the force, in controlled and free flight.", None, MovingParts, false, true, 1e-2, Writer::Propellant;
}

impl Effect {
    /// Number of effects.
    pub const COUNT: usize = Self::ALL.len();

    /// Number of effects of light and heat, which stand first.
    pub const LIGHT: usize = Self::count(Grid::Light);

    /// Number of effects by a dipole in the magnetic field.
    pub const IN_FIELD: usize = Self::count(Grid::Field);

    const fn count(grid: Grid) -> usize {
        let (mut count, mut k) = (0, 0);
        while k < Self::COUNT {
            count += (Self::ALL[k].row().grid as usize == grid as usize) as usize;
            k += 1;
        }
        count
    }

    /// Effects by a dipole in the magnetic field, in the table's order.
    pub const FIELD: [Self; Self::IN_FIELD] = {
        let (mut rows, mut place, mut k) = ([Self::ALL[0]; Self::IN_FIELD], 0, 0);
        while k < Self::COUNT {
            if Self::ALL[k].is_in_field() {
                rows[place] = Self::ALL[k];
                place += 1;
            }
            k += 1;
        }
        rows
    };

    /// Whether it is of light and heat.
    pub const fn is_light(self) -> bool {
        matches!(self.row().grid, Grid::Light)
    }

    /// Whether it is computed by the attitude at every time, in a field on the disturbance grid.
    pub const fn is_in_field(self) -> bool {
        matches!(self.row().grid, Grid::Field)
    }

    /// Whether it is an environmental disturbance.
    pub const fn is_disturbance(self) -> bool {
        !matches!(self.row().grid, Grid::Motion | Grid::MovingParts)
    }

    /// Whether parts that move in the body exert it.
    pub const fn is_by_moving_parts(self) -> bool {
        matches!(self.row().grid, Grid::MovingParts)
    }
}

const _: () = assert!(Effect::ALL[Effect::LIGHT - 1].is_light(), "effects of light and heat stand first");

/// Effects that act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Active([bool; Effect::COUNT]);

impl Active {
    /// Effects whose switch is on, or that have none.
    pub fn by(is_on: impl Fn(Switch) -> bool) -> Self {
        Self(Effect::ALL.map(|effect| effect.row().switch.is_none_or(&is_on)))
    }

    /// Whether an effect acts.
    pub fn has(self, effect: Effect) -> bool {
        self.0[effect as usize]
    }

    /// Whether one of these effects acts.
    pub fn has_any(self, effects: &[Effect]) -> bool {
        effects.iter().any(|effect| self.has(*effect))
    }

    /// Whether the effects of a switch act.
    pub fn is_on(self, switch: Switch) -> bool {
        Effect::ALL.into_iter().any(|effect| effect.row().switch == Some(switch) && self.has(effect))
    }

    /// The disturbances that act.
    pub fn disturbances(self) -> impl Iterator<Item = Effect> {
        Effect::ALL.into_iter().filter(move |effect| effect.is_disturbance() && self.has(*effect))
    }

    /// Active effects of light and heat.
    pub fn light(self) -> impl Iterator<Item = Effect> {
        self.disturbances().filter(|effect| effect.is_light())
    }
}
