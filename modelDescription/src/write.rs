//! The XML writer: UTF-8, two spaces a level, attributes left out where they equal their default.

use crate::element::Element;
use crate::writer::Writer;
use crate::{Annotation, Description, ScalarVariable, SimpleType, SimpleTypeKind, Unit, Unknown};

/// The `modelDescription.xml` of a description, in the order of the FMI 2.0.5 schema.
///
/// The same description gives the same bytes. Characters that XML 1.0 cannot carry, not even escaped (most
/// control characters), become U+FFFD.
pub fn to_xml(description: &Description) -> String {
    written(description).finish()
}

/// The attributes that hold what XML cannot carry: element, name, the first such character.
pub(crate) fn illegal_characters(description: &Description) -> Vec<(String, &'static str, char)> {
    written(description).illegal
}

fn written(description: &Description) -> Writer {
    let mut out = Writer::new();
    out.element("fmiModelDescription", |out| {
        out.attribute("fmiVersion", &"2.0".to_owned());
        description.write(out);
        if let Some(flags) = &description.model_exchange {
            out.interface("ModelExchange", flags, &flags.source_files);
        }
        if let Some(flags) = &description.co_simulation {
            out.interface("CoSimulation", flags, &flags.source_files);
        }
        out.list("UnitDefinitions", &description.units, Writer::unit);
        out.list("TypeDefinitions", &description.types, Writer::simple_type);
        out.list("LogCategories", &description.log_categories, |out, it| out.leaf("Category", it));
        if let Some(experiment) = &description.default_experiment {
            out.leaf("DefaultExperiment", experiment);
        }
        let tool = description.annotation_tool.as_ref();
        out.element("ModelVariables", |out| {
            description.variables.iter().for_each(|it| out.variable(it, tool));
        });
        out.element("ModelStructure", |out| {
            let unknown = |out: &mut Writer, it: &Unknown| out.leaf("Unknown", it);
            out.list("Outputs", &description.structure.outputs, unknown);
            out.list("Derivatives", &description.structure.derivatives, unknown);
            out.list("InitialUnknowns", &description.structure.initial_unknowns, unknown);
        });
    });
    out
}

impl Writer {
    fn leaf(&mut self, name: &'static str, element: &impl Element) {
        self.element(name, |out| element.write(out));
    }

    fn interface(&mut self, name: &'static str, flags: &impl Element, source_files: &[String]) {
        self.element(name, |out| {
            flags.write(out);
            out.list("SourceFiles", source_files, |out, file| {
                out.element("File", |out| out.attribute("name", file));
            });
        });
    }

    fn unit(&mut self, unit: &Unit) {
        self.element("Unit", |out| {
            unit.write(out);
            unit.base.iter().for_each(|base| out.leaf("BaseUnit", base));
            unit.display_units.iter().for_each(|display| out.leaf("DisplayUnit", display));
        });
    }

    fn simple_type(&mut self, simple_type: &SimpleType) {
        self.element("SimpleType", |out| {
            simple_type.write(out);
            out.element(simple_type.kind.name(), |out| {
                simple_type.kind.write(out);
                if let SimpleTypeKind::Enumeration { items, .. } = &simple_type.kind {
                    items.iter().for_each(|item| out.leaf("Item", item));
                }
            });
        });
    }

    fn variable(&mut self, variable: &ScalarVariable, tool: Option<&String>) {
        self.element("ScalarVariable", |out| {
            variable.write(out);
            out.element(variable.kind.name(), |out| variable.kind.write(out));
            if let Some((annotation, tool)) = variable.annotation.as_deref().zip(tool) {
                out.element("Annotations", |out| out.annotation(annotation, tool));
            }
        });
    }

    fn annotation(&mut self, annotation: &Annotation, tool: &String) {
        self.element("Tool", |out| {
            out.attribute("name", tool);
            out.element("Variable", |out| {
                annotation.write(out);
                annotation.read_where.iter().for_each(|it| out.leaf("ReadWhere", it));
            });
        });
    }
}
