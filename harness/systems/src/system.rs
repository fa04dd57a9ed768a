//! A system opened from an SSP: its components with their FMUs, its connections and parameters, all checked.

use std::{collections::HashMap, path::Path};

use fmi::{Fmu, Times, Value};
use model_description::{Causality, Description, value};

use crate::{
    error::Error,
    experiment::complete,
    joint::{ConnectedVariable, Joint, Link, check_connector, link},
    merged::{Merged, merge},
    own::{Own, describe},
    package::Package,
    parameter_mapping, parameter_set, parameters, reader,
    structure::{Binding, Linear, SSD_FILE, Structure},
    unread::{Unread, unread},
};

/// A component with its FMU.
#[derive(Debug)]
pub struct Part {
    /// Its name in the system.
    pub name: String,
    /// Its FMU.
    pub fmu: Fmu,
    /// Values that the system gives it, the later one of two.
    pub parameters: Vec<(String, Value)>,
}

/// An opened system.
pub struct System {
    package: Package,
    structure: Structure,
    parts: Vec<Part>,
    joints: Vec<Joint>,
    own: Vec<Own>,
    merged: Merged,
}

impl std::fmt::Debug for System {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("System").field("package", &self.package).finish_non_exhaustive()
    }
}

impl System {
    /// Opens an `.ssp` file, or the folder that one was unpacked into, and holds its connectors, connections and
    /// parameters against its FMUs. No library is loaded.
    ///
    /// # Errors
    /// The first thing that cannot be simulated, with file, line, what was found and what is allowed.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let package = Package::open(path.as_ref())?;
        let structure = reader::read(&package.read(SSD_FILE)?)
            .map_err(|error| package.structure(SSD_FILE, error.to_string()))?;
        let at = |line: u32, what: String| package.structure(SSD_FILE, format!("line {line}: {what}"));
        let fmus = open_fmus(&package, &structure, at)?;
        for (component, fmu) in structure.components.iter().zip(&fmus) {
            for connector in &component.connectors {
                check_connector(&structure, fmu, connector).map_err(|what| {
                    at(connector.line, format!("connector {}.{}: {what}", component.name, connector.name))
                })?;
            }
        }
        let mut joints: Vec<Joint> = Vec::with_capacity(structure.connections.len());
        let mut joined: HashMap<(usize, usize), u32> = HashMap::new();
        let mut own: Vec<Own> = structure.connectors.iter().map(Own::new).collect();
        for connection in &structure.connections {
            let refuse = |what: String| {
                let (start, end) = (&connection.start, &connection.end);
                at(connection.line, format!("connection {start} to {end}: {what}"))
            };
            let taken =
                |line: u32| refuse(format!("its end is connected already in line {line}, allowed: once"));
            let input = match link(&structure, &fmus, connection).map_err(refuse)? {
                Link::Joint(joint) => {
                    joints.push(joint.clone());
                    Some(joint.to)
                }
                Link::Own(name, place) => {
                    let own = own.iter_mut().filter(|own| own.connector.name == name);
                    own.filter_map(|own| own.join(place, connection.line))
                        .next()
                        .map_or(Ok(()), |line| Err(taken(line)))?;
                    connection.end.component.is_some().then_some(place.at)
                }
            };
            if let Some(line) = input.and_then(|input| joined.insert(input, connection.line)) {
                return Err(taken(line));
            }
        }
        let mut parts: Vec<Part> = structure
            .components
            .iter()
            .zip(&fmus)
            .map(|(component, fmu)| Part {
                name: component.name.clone(),
                fmu: fmu.clone(),
                parameters: Vec::new(),
            })
            .collect();
        // The system's own come last: they win over a component's.
        let of_components = structure.components.iter().enumerate();
        for (number, component) in of_components {
            for binding in &component.bindings {
                bind(&package, &structure, (&fmus, &own), (Some(number), binding), &mut parts)?;
            }
        }
        for binding in &structure.bindings {
            bind(&package, &structure, (&fmus, &own), (None, binding), &mut parts)?;
        }
        let named = || parts.iter().map(|part| (part.name.as_str(), &part.fmu));
        let mut merged = merge(&structure.name, complete(structure.experiment, fmus.iter()), named());
        own.retain(|own| !own.places.is_empty());
        for own in &own {
            describe(&mut merged, &structure, &fmus, own).map_err(|what| {
                at(own.connector.line, format!("the system's own connector {}: {what}", own.connector.name))
            })?;
        }
        Ok(Self { package, structure, parts, joints, own, merged })
    }

    /// Returns the connected inputs that are not read, with these values of `component.name` set over the system's own.
    pub fn unread(&self, sets: &[(String, Value)]) -> Vec<Unread> {
        let of_part = |(number, part): (usize, &Part)| {
            let description = part.fmu.description();
            let ends = self.joints.iter().map(|joint| joint.to);
            let own = self.own.iter().filter(|own| own.gives()).flat_map(|own| &own.places);
            let connected = ends.chain(own.map(|place| place.at)).filter(|at| at.0 == number);
            let connected: Vec<&str> =
                connected.map(|(_, position)| description.variables[position].name.as_str()).collect();
            let given = |option: &str| {
                let full = format!("{}.{option}", part.name);
                let set = sets.iter().rev().find(|(name, _)| *name == full);
                let own = part.parameters.iter().find(|(name, _)| name == option);
                let known = set.or(own).map(|(_, value)| value.clone());
                match known.or_else(|| value::start(part.fmu.find(option)?))? {
                    Value::Integer(number) => Some(number),
                    _ => None,
                }
            };
            unread(&part.name, description, &connected, given)
        };
        self.parts.iter().enumerate().flat_map(of_part).collect()
    }

    /// The path it was opened from.
    pub fn source(&self) -> &Path {
        &self.package.source
    }

    /// The folder it is unpacked in, which can be opened too.
    pub fn folder(&self) -> &Path {
        &self.package.folder
    }

    /// Its description.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Its components, in the order in which a master calls them.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Its connections.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The system's own connectors that a connection joins to variables.
    pub fn own(&self) -> &[Own] {
        &self.own
    }

    /// The variables of all components, named `component.variable`, then the system's own connectors by their names, and the
    /// default experiment.
    pub fn description(&self) -> &Description {
        &self.merged.description
    }

    /// Returns the variables that one of [`System::description`] stands for: one variable of a component, or for an input of the system itself
    /// all that it is connected to.
    pub fn places(&self, position: usize) -> Vec<ConnectedVariable> {
        match self.merged.origins.get(position) {
            Some(&at) => vec![ConnectedVariable { at, linear: Linear::IDENTITY }],
            None => self.own[position - self.merged.origins.len()].places.clone(),
        }
    }

    /// Component and position of every input that nothing is connected to.
    pub fn open_inputs(&self) -> Vec<(usize, usize)> {
        let variables = |number: usize| &self.parts[number].fmu.description().variables;
        let all = self.merged.origins.iter().copied();
        all.filter(|&(number, position)| {
            variables(number)[position].causality == Causality::Input
                && !self.joints.iter().any(|joint| joint.to == (number, position))
                && !self.own.iter().any(|own| own.has(number, position))
        })
        .collect()
    }

    /// The times of a run: what is given, else the default experiment's.
    ///
    /// # Errors
    /// Times that make no run, and steps that an FMU does not take.
    pub fn times(
        &self,
        start_s: Option<f64>,
        stop_s: Option<f64>,
        step_s: Option<f64>,
    ) -> Result<Times, fmi::Error> {
        let times = Times::of_default(&self.merged.description, start_s, stop_s, step_s)?;
        self.parts.iter().try_for_each(|part| times.fit(&part.fmu))?;
        Ok(times)
    }
}

/// The FMUs of the components, one where several components are of the same file.
fn open_fmus(
    package: &Package,
    structure: &Structure,
    at: impl Fn(u32, String) -> Error,
) -> Result<Vec<Fmu>, Error> {
    if structure.components.is_empty() {
        return Err(package.structure(SSD_FILE, "the system has no component".to_owned()));
    }
    let mut fmus: Vec<Fmu> = Vec::with_capacity(structure.components.len());
    for (number, component) in structure.components.iter().enumerate() {
        let earlier = &structure.components[..number];
        if earlier.iter().any(|it| it.name == component.name) {
            let what = format!("component {:?} stands twice, allowed: once", component.name);
            return Err(at(component.line, what));
        }
        if let Some(same) = earlier.iter().position(|it| it.source == component.source) {
            let once = fmus[same].description().co_simulation.as_ref();
            if once.is_some_and(|it| it.can_be_instantiated_only_once_per_process) {
                let what = format!(
                    "component {:?}: its FMU may have one instance alone, and {:?} is one",
                    component.name, structure.components[same].name
                );
                return Err(at(component.line, what));
            }
            fmus.push(fmus[same].clone());
            continue;
        }
        let refuse = |error| Error::Component {
            path: package.source.clone(),
            component: component.name.clone(),
            source: Box::new(error),
        };
        let folder = package.fmu_folder(&component.source).map_err(|error| match error {
            Error::Structure { what, .. } => {
                at(component.line, format!("component {:?}: {what}", component.name))
            }
            other => other,
        })?;
        let fmu = Fmu::open(folder).map_err(refuse)?;
        fmu.co_simulation().map_err(refuse)?;
        fmus.push(fmu);
    }
    Ok(fmus)
}

/// Adds the values of a binding.
fn bind(
    package: &Package,
    structure: &Structure,
    (fmus, own): (&[Fmu], &[Own]),
    (component, binding): (Option<usize>, &Binding),
    parts: &mut [Part],
) -> Result<(), Error> {
    let mut sets: Vec<_> = binding.sets.iter().map(|set| (SSD_FILE, set.clone())).collect();
    if let Some(source) = &binding.source {
        let set = parameter_set::read(&package.read(source)?)
            .map_err(|error| package.structure(source, error.to_string()))?;
        sets.push((source, set));
    }
    let refuse =
        |file: &str, (line, what): (u32, String)| package.structure(file, format!("line {line}: {what}"));
    let mut mapping = binding.mapping.clone();
    let mapping_file = mapping.as_ref().and_then(|it| it.source.clone());
    if let (Some(mapping), Some(source)) = (&mut mapping, &mapping_file) {
        let entries = parameter_mapping::read(&package.read(source)?)
            .map_err(|error| package.structure(source, error.to_string()))?;
        mapping.entries.extend(entries);
    }
    let mapping_file = mapping_file.as_deref().unwrap_or(SSD_FILE);
    if let Some(mapping) = &mapping {
        let all: Vec<_> = sets.iter().map(|(_, set)| set).collect();
        mapping.check(&binding.prefix, &all).map_err(|error| refuse(mapping_file, error))?;
    }
    for (file, set) in &sets {
        let mapped = parameter_mapping::mapped(mapping.as_ref(), &binding.prefix, set)
            .map_err(|error| refuse(mapping_file, error))?;
        let mut found = Vec::new();
        for mapped in &mapped {
            // A mapped one has the line of its entry.
            let file = if mapped.is_mapped { mapping_file } else { file };
            let mapped = std::slice::from_ref(mapped);
            let values = parameters::values(structure, (fmus, own), component, &set.units, mapped);
            found.extend(values.map_err(|error| refuse(file, error))?);
        }
        for (number, name, value) in found {
            let known = &mut parts[number].parameters;
            known.retain(|(earlier, _)| *earlier != name);
            known.push((name, value));
        }
    }
    Ok(())
}
