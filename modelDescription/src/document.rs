//! A description as a sequence of elements and attributes in the order of the XML schema.
//!
//! The XML writer walks it.

use crate::{
    Causality, CoSimulation, Description, ModelExchange, ModelStructure, NamingConvention, RealAttributes,
    ScalarVariable, SimpleType, SimpleTypeKind, Unit, Unknown, Variability, VariableKind,
};

/// Receives the document.
pub(crate) trait Sink {
    /// A new element; the attributes that follow are its own until the next `open` or `close`.
    fn open(&mut self, element: &'static str);
    /// An attribute whose text is plain, unescaped.
    fn attribute(&mut self, name: &'static str, text: &str);
    /// The end of the last open element.
    fn close(&mut self);
}

/// The lexical form of xs:double that reads back to the same bits: shortest digits, `INF`, `-INF`, `NaN`.
pub(crate) fn double(value: f64) -> String {
    if value.is_nan() {
        "NaN".to_owned()
    } else if value.is_infinite() {
        if value > 0.0 { "INF".to_owned() } else { "-INF".to_owned() }
    } else {
        let mut text = format!("{value:?}");
        if text.ends_with(".0") {
            text.truncate(text.len() - 2);
        }
        text
    }
}

/// Walks the whole description.
pub(crate) fn walk(description: &Description, sink: &mut impl Sink) {
    let mut out = Elements { sink };
    out.element("fmiModelDescription", |out| {
        out.text("fmiVersion", "2.0");
        out.text("modelName", &description.model_name);
        out.text("guid", &description.guid);
        out.optional("description", description.description.as_deref());
        out.optional("author", description.author.as_deref());
        out.optional("version", description.version.as_deref());
        out.optional("copyright", description.copyright.as_deref());
        out.optional("license", description.license.as_deref());
        out.optional("generationTool", description.generation_tool.as_deref());
        out.optional("generationDateAndTime", description.generation_date_and_time.as_deref());
        if description.variable_naming != NamingConvention::Flat {
            out.text("variableNamingConvention", description.variable_naming.as_str());
        }
        out.shown("numberOfEventIndicators", description.number_of_event_indicators);

        if let Some(model_exchange) = &description.model_exchange {
            out.model_exchange(model_exchange);
        }
        if let Some(co_simulation) = &description.co_simulation {
            out.co_simulation(co_simulation);
        }
        out.list("UnitDefinitions", &description.units, Elements::unit);
        out.list("TypeDefinitions", &description.types, Elements::simple_type);
        out.list("LogCategories", &description.log_categories, |out, category| {
            out.element("Category", |out| {
                out.text("name", &category.name);
                out.optional("description", category.description.as_deref());
            });
        });
        if let Some(experiment) = &description.default_experiment {
            out.element("DefaultExperiment", |out| {
                out.double("startTime", experiment.start_time);
                out.double("stopTime", experiment.stop_time);
                out.double("tolerance", experiment.tolerance);
                out.double("stepSize", experiment.step_size);
            });
        }
        out.element("ModelVariables", |out| {
            for variable in &description.variables {
                out.variable(variable);
            }
        });
        out.structure(&description.structure);
    });
}

struct Elements<'a, S> {
    sink: &'a mut S,
}

impl<S: Sink> Elements<'_, S> {
    fn element(&mut self, name: &'static str, content: impl FnOnce(&mut Self)) {
        self.sink.open(name);
        content(self);
        self.sink.close();
    }

    fn list<T>(&mut self, name: &'static str, items: &[T], mut item: impl FnMut(&mut Self, &T)) {
        if !items.is_empty() {
            self.element(name, |out| items.iter().for_each(|value| item(out, value)));
        }
    }

    fn text(&mut self, name: &'static str, text: &str) {
        self.sink.attribute(name, text);
    }

    fn optional(&mut self, name: &'static str, text: Option<&str>) {
        if let Some(text) = text {
            self.text(name, text);
        }
    }

    fn shown<T: ToString>(&mut self, name: &'static str, value: Option<T>) {
        if let Some(value) = value {
            self.text(name, &value.to_string());
        }
    }

    fn double(&mut self, name: &'static str, value: Option<f64>) {
        if let Some(value) = value {
            self.text(name, &double(value));
        }
    }

    fn flag(&mut self, name: &'static str, value: bool) {
        if value {
            self.text(name, "true");
        }
    }

    fn scale(&mut self, factor: f64, offset: f64) {
        self.double("factor", (factor != 1.0).then_some(factor));
        self.double("offset", (offset != 0.0).then_some(offset));
    }

    fn source_files(&mut self, files: &[String]) {
        self.list("SourceFiles", files, |out, file| {
            out.element("File", |out| out.text("name", file));
        });
    }

    fn model_exchange(&mut self, flags: &ModelExchange) {
        self.element("ModelExchange", |out| {
            out.text("modelIdentifier", &flags.model_identifier);
            out.flag("needsExecutionTool", flags.needs_execution_tool);
            out.flag("completedIntegratorStepNotNeeded", flags.completed_integrator_step_not_needed);
            out.flag("canBeInstantiatedOnlyOncePerProcess", flags.can_be_instantiated_only_once_per_process);
            out.flag("canNotUseMemoryManagementFunctions", flags.can_not_use_memory_management_functions);
            out.flag("canGetAndSetFMUstate", flags.can_get_and_set_fmu_state);
            out.flag("canSerializeFMUstate", flags.can_serialize_fmu_state);
            out.flag("providesDirectionalDerivative", flags.provides_directional_derivative);
            out.source_files(&flags.source_files);
        });
    }

    fn co_simulation(&mut self, flags: &CoSimulation) {
        self.element("CoSimulation", |out| {
            out.text("modelIdentifier", &flags.model_identifier);
            out.flag("needsExecutionTool", flags.needs_execution_tool);
            out.flag(
                "canHandleVariableCommunicationStepSize",
                flags.can_handle_variable_communication_step_size,
            );
            out.flag("canInterpolateInputs", flags.can_interpolate_inputs);
            let order = flags.max_output_derivative_order;
            out.shown("maxOutputDerivativeOrder", (order != 0).then_some(order));
            out.flag("canRunAsynchronuously", flags.can_run_asynchronuously);
            out.flag("canBeInstantiatedOnlyOncePerProcess", flags.can_be_instantiated_only_once_per_process);
            out.flag("canNotUseMemoryManagementFunctions", flags.can_not_use_memory_management_functions);
            out.flag("canGetAndSetFMUstate", flags.can_get_and_set_fmu_state);
            out.flag("canSerializeFMUstate", flags.can_serialize_fmu_state);
            out.flag("providesDirectionalDerivative", flags.provides_directional_derivative);
            out.source_files(&flags.source_files);
        });
    }

    fn unit(&mut self, unit: &Unit) {
        self.element("Unit", |out| {
            out.text("name", &unit.name);
            if let Some(base) = &unit.base {
                out.element("BaseUnit", |out| {
                    for (symbol, exponent) in base.exponents() {
                        out.shown(symbol, (exponent != 0).then_some(exponent));
                    }
                    out.scale(base.factor, base.offset);
                });
            }
            for display in &unit.display_units {
                out.element("DisplayUnit", |out| {
                    out.text("name", &display.name);
                    out.scale(display.factor, display.offset);
                });
            }
        });
    }

    fn simple_type(&mut self, simple_type: &SimpleType) {
        self.element("SimpleType", |out| {
            out.text("name", &simple_type.name);
            out.optional("description", simple_type.description.as_deref());
            match &simple_type.kind {
                SimpleTypeKind::Real(attributes) => {
                    out.element("Real", |out| out.real_attributes(attributes));
                }
                SimpleTypeKind::Integer { quantity, min, max } => {
                    out.element("Integer", |out| out.integer_attributes(quantity.as_deref(), *min, *max));
                }
                SimpleTypeKind::Boolean => out.element("Boolean", |_| {}),
                SimpleTypeKind::String => out.element("String", |_| {}),
                SimpleTypeKind::Enumeration { quantity, items } => out.element("Enumeration", |out| {
                    out.optional("quantity", quantity.as_deref());
                    for item in items {
                        out.element("Item", |out| {
                            out.text("name", &item.name);
                            out.shown("value", Some(item.value));
                            out.optional("description", item.description.as_deref());
                        });
                    }
                }),
            }
        });
    }

    fn real_attributes(&mut self, attributes: &RealAttributes) {
        self.optional("quantity", attributes.quantity.as_deref());
        self.optional("unit", attributes.unit.as_deref());
        self.optional("displayUnit", attributes.display_unit.as_deref());
        self.flag("relativeQuantity", attributes.relative_quantity);
        self.double("min", attributes.min);
        self.double("max", attributes.max);
        self.double("nominal", attributes.nominal);
        self.flag("unbounded", attributes.unbounded);
    }

    fn integer_attributes(&mut self, quantity: Option<&str>, min: Option<i32>, max: Option<i32>) {
        self.optional("quantity", quantity);
        self.shown("min", min);
        self.shown("max", max);
    }

    fn variable(&mut self, variable: &ScalarVariable) {
        self.element("ScalarVariable", |out| {
            out.text("name", &variable.name);
            out.shown("valueReference", Some(variable.value_reference));
            out.optional("description", variable.description.as_deref());
            if variable.causality != Causality::default() {
                out.text("causality", variable.causality.as_str());
            }
            if variable.variability != Variability::default() {
                out.text("variability", variable.variability.as_str());
            }
            out.shown("initial", variable.initial);
            out.shown(
                "canHandleMultipleSetPerTimeInstant",
                variable.can_handle_multiple_set_per_time_instant,
            );
            out.kind(&variable.kind);
        });
    }

    fn kind(&mut self, kind: &VariableKind) {
        match kind {
            VariableKind::Real { start, declared_type, attributes, derivative, reinit } => {
                self.element("Real", |out| {
                    out.optional("declaredType", declared_type.as_deref());
                    out.real_attributes(attributes);
                    out.double("start", *start);
                    out.shown("derivative", *derivative);
                    out.shown("reinit", *reinit);
                });
            }
            VariableKind::Integer { start, declared_type, quantity, min, max } => {
                self.element("Integer", |out| {
                    out.optional("declaredType", declared_type.as_deref());
                    out.integer_attributes(quantity.as_deref(), *min, *max);
                    out.shown("start", *start);
                });
            }
            VariableKind::Boolean { start, declared_type } => self.element("Boolean", |out| {
                out.optional("declaredType", declared_type.as_deref());
                out.shown("start", *start);
            }),
            VariableKind::String { start, declared_type } => self.element("String", |out| {
                out.optional("declaredType", declared_type.as_deref());
                out.optional("start", start.as_deref());
            }),
            VariableKind::Enumeration { start, declared_type, quantity, min, max } => {
                self.element("Enumeration", |out| {
                    out.text("declaredType", declared_type);
                    out.integer_attributes(quantity.as_deref(), *min, *max);
                    out.shown("start", *start);
                });
            }
        }
    }

    fn structure(&mut self, structure: &ModelStructure) {
        self.element("ModelStructure", |out| {
            out.list("Outputs", &structure.outputs, Self::unknown);
            out.list("Derivatives", &structure.derivatives, Self::unknown);
            out.list("InitialUnknowns", &structure.initial_unknowns, Self::unknown);
        });
    }

    fn unknown(&mut self, unknown: &Unknown) {
        self.element("Unknown", |out| {
            out.shown("index", Some(unknown.index));
            out.optional("dependencies", unknown.dependencies.as_deref().map(spaced).as_deref());
            out.optional("dependenciesKind", unknown.dependencies_kind.as_deref().map(spaced).as_deref());
        });
    }
}

fn spaced<T: ToString>(values: &[T]) -> String {
    values.iter().map(T::to_string).collect::<Vec<_>>().join(" ")
}
