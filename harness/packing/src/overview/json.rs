//! Description of an FMU or a system as one JSON object.

use fmi::Value as StartValue;
use model_description::{Description, VariableKind, value};
use serde_json::{Map, Value, json};

use super::causality::causality;

/// Variables at these positions, and the items of the options that they take.
fn variables(description: &Description, positions: &[usize]) -> (Vec<Value>, Map<String, Value>) {
    let mut options = Map::new();
    let mut all = Vec::with_capacity(positions.len());
    for variable in positions.iter().map(|&position| &description.variables[position]) {
        let option = match &variable.kind {
            VariableKind::Enumeration { declared_type, .. } => Some(declared_type),
            _ => None,
        };
        if let Some(option) = option {
            let items = value::items(description, variable).iter().map(
                |item| json!({ "name": item.name, "value": item.value, "description": item.description }),
            );
            options.insert(option.clone(), items.collect());
        }
        let start = value::start(variable).map(|start| match start {
            StartValue::Real(number) => json!(number),
            StartValue::Integer(number) => json!(number),
            StartValue::Boolean(truth) => json!(truth),
            StartValue::Text(text) => json!(text),
        });
        all.push(json!({
            "name": variable.name,
            "causality": causality(variable),
            "start": start,
            "unit": fmi::unit(description, variable),
            "option": option,
            "description": variable.description,
        }));
    }
    (all, options)
}

/// Returns the object of a description, with the variables at these positions.
pub fn object(file: &str, description: &Description, positions: &[usize]) -> Value {
    let (variables, options) = variables(description, positions);
    let experiment = description.default_experiment.map(|it| {
        json!({ "start_s": it.start_time, "stop_s": it.stop_time, "step_s": it.step_size, "tolerance": it.tolerance })
    });
    json!({
        "file": file,
        "name": description.model_name,
        "guid": description.guid,
        "description": description.description,
        "version": description.version,
        "generationTool": description.generation_tool,
        "defaultExperiment": experiment,
        "variables": variables,
        "options": options,
    })
}
