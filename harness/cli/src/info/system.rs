//! `heliotorque info` of a system: its components, what is connected, what is open.

use packing::overview::experiment::times;
use systems::System;

use crate::wire::{grouped, vector, wrapped};

/// The tables.
pub(super) fn text(system: &System) -> String {
    let structure = system.structure();
    let mut components =
        terminal::table(&[structure.name.as_str(), "FMU", "model", "parameters", "open inputs"]);
    let open = system.open_inputs();
    for (number, part) in system.parts().iter().enumerate() {
        let source = structure.components.get(number).map_or("", |it| it.source.as_str());
        components.add_row([
            part.name.clone(),
            source.to_owned(),
            part.fmu.name().to_owned(),
            part.parameters.len().to_string(),
            open.iter().filter(|input| input.0 == number).count().to_string(),
        ]);
    }
    let name = |(number, position): (usize, usize)| {
        let part = &system.parts()[number];
        (part.name.clone(), vector(&part.fmu.description().variables[position].name))
    };
    let own = system.own().iter().flat_map(|own| own.places.iter().map(move |place| (own, place.at)));
    let own = own.map(|(own, at)| {
        let (part, variable) = name(at);
        let ends =
            if own.gives() { format!("the system to {part}") } else { format!("{part} to the system") };
        let outer = vector(&own.connector.name);
        let joined = if outer == variable { outer } else { format!("{outer}, {variable} of {part}") };
        (ends, joined)
    });
    let joined = grouped(
        system
            .joints()
            .iter()
            .map(|joint| {
                let ((from, output), (to, input)) = (name(joint.from), name(joint.to));
                let joined = if output == input { output } else { format!("{output} to {input}") };
                (format!("{from} to {to}"), joined)
            })
            .chain(own),
    );
    let left = grouped(open.into_iter().map(name));
    let experiment = system.description().default_experiment.unwrap_or_default();
    let lists = [
        (joined, format!("{} connections", system.structure().connections.len())),
        (left, "open inputs".to_owned()),
    ];
    let mut text = vec![components.to_string(), format!("default experiment: {}", times(&experiment))];
    for (groups, title) in lists {
        let lines: Vec<String> =
            groups.iter().map(|(of, names)| format!("\n  {of}:{}", wrapped(names))).collect();
        text.push(format!("{title}{}", lines.concat()));
    }
    text.join("\n\n")
}
