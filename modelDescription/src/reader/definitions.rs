//! Interfaces, units, types, log categories, default experiment, annotations.

use std::collections::BTreeSet;

use super::fields::Fields;
use super::xml::Start;
use super::{Read, ReadError, lacks, twice};
use crate::finding::Code;
use crate::{
    BaseUnit, CoSimulation, DefaultExperiment, DisplayUnit, EnumerationItem, LogCategory, ModelExchange,
    RealAttributes, SimpleType, SimpleTypeKind, Unit,
};

impl Read<'_> {
    pub(super) fn model_exchange(&mut self, start: &mut Start) -> Result<(), ReadError> {
        self.lines.model_exchange = start.line;
        let mut fields = Fields::of(start);
        let mut flags = ModelExchange {
            model_identifier: fields.required("modelIdentifier")?,
            needs_execution_tool: fields.flag("needsExecutionTool")?,
            completed_integrator_step_not_needed: fields.flag("completedIntegratorStepNotNeeded")?,
            can_be_instantiated_only_once_per_process: fields.flag("canBeInstantiatedOnlyOncePerProcess")?,
            can_not_use_memory_management_functions: fields.flag("canNotUseMemoryManagementFunctions")?,
            can_get_and_set_fmu_state: fields.flag("canGetAndSetFMUstate")?,
            can_serialize_fmu_state: fields.flag("canSerializeFMUstate")?,
            provides_directional_derivative: fields.flag("providesDirectionalDerivative")?,
            source_files: Vec::new(),
        };
        fields.finish(&mut self.xml);
        flags.source_files = self.source_files(start)?;
        self.description.model_exchange = Some(flags);
        Ok(())
    }

    pub(super) fn co_simulation(&mut self, start: &mut Start) -> Result<(), ReadError> {
        self.lines.co_simulation = start.line;
        let mut fields = Fields::of(start);
        let variable_step = "canHandleVariableCommunicationStepSize";
        let mut flags = CoSimulation {
            model_identifier: fields.required("modelIdentifier")?,
            needs_execution_tool: fields.flag("needsExecutionTool")?,
            can_handle_variable_communication_step_size: fields.flag(variable_step)?,
            can_interpolate_inputs: fields.flag("canInterpolateInputs")?,
            max_output_derivative_order: fields.unsigned("maxOutputDerivativeOrder")?.unwrap_or(0),
            can_run_asynchronuously: fields.flag("canRunAsynchronuously")?,
            can_be_instantiated_only_once_per_process: fields.flag("canBeInstantiatedOnlyOncePerProcess")?,
            can_not_use_memory_management_functions: fields.flag("canNotUseMemoryManagementFunctions")?,
            can_get_and_set_fmu_state: fields.flag("canGetAndSetFMUstate")?,
            can_serialize_fmu_state: fields.flag("canSerializeFMUstate")?,
            provides_directional_derivative: fields.flag("providesDirectionalDerivative")?,
            source_files: Vec::new(),
        };
        fields.finish(&mut self.xml);
        flags.source_files = self.source_files(start)?;
        self.description.co_simulation = Some(flags);
        Ok(())
    }

    fn source_files(&mut self, start: &Start) -> Result<Vec<String>, ReadError> {
        let mut files = Vec::new();
        let mut seen = false;
        while let Some(mut child) = self.xml.child(start)? {
            if child.name != "SourceFiles" {
                self.unknown(&child)?;
                continue;
            }
            if core::mem::replace(&mut seen, true) {
                return Err(twice(&child));
            }
            self.list(&mut child, "File", |read, file| {
                let mut fields = Fields::of(file);
                files.push(fields.required("name")?);
                fields.finish(&mut read.xml);
                read.leaf(file)
            })?;
        }
        Ok(files)
    }

    pub(super) fn unit(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let mut fields = Fields::of(start);
        let mut unit = Unit { name: fields.required("name")?, ..Unit::default() };
        fields.finish(&mut self.xml);
        while let Some(mut child) = self.xml.child(start)? {
            let mut fields = Fields::of(&mut child);
            match child.name.as_str() {
                "BaseUnit" if unit.base.is_some() => return Err(twice(&child)),
                "BaseUnit" => {
                    let factor = fields.double("factor")?.unwrap_or(1.0);
                    let offset = fields.double("offset")?.unwrap_or(0.0);
                    let exponent = |symbol| fields.int(symbol).map(|value| value.unwrap_or(0));
                    unit.base = Some(BaseUnit::of(exponent, factor, offset)?);
                }
                "DisplayUnit" => unit.display_units.push(DisplayUnit {
                    name: fields.required("name")?,
                    factor: fields.double("factor")?.unwrap_or(1.0),
                    offset: fields.double("offset")?.unwrap_or(0.0),
                }),
                _ => {
                    self.unknown(&child)?;
                    continue;
                }
            }
            fields.finish(&mut self.xml);
            self.leaf(&child)?;
        }
        self.lines.units.push(start.line);
        self.description.units.push(unit);
        Ok(())
    }

    pub(super) fn simple_type(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let mut fields = Fields::of(start);
        let name = fields.required("name")?;
        let description = fields.text("description");
        fields.finish(&mut self.xml);
        let mut kind = None;
        while let Some(mut child) = self.xml.child(start)? {
            let Some(read) = self.type_kind(&mut child)? else { continue };
            if kind.replace(read).is_some() {
                return Err(twice(&child));
            }
        }
        let kind = kind.ok_or_else(|| lacks(start, "Real, Integer, Boolean, String or Enumeration"))?;
        self.lines.types.push(start.line);
        self.description.types.push(SimpleType { name, description, kind });
        Ok(())
    }

    fn type_kind(&mut self, start: &mut Start) -> Result<Option<SimpleTypeKind>, ReadError> {
        let mut fields = Fields::of(start);
        let kind = match start.name.as_str() {
            "Real" => SimpleTypeKind::Real(real_attributes(&mut fields)?),
            "Integer" => SimpleTypeKind::Integer {
                quantity: fields.text("quantity"),
                min: fields.int("min")?,
                max: fields.int("max")?,
            },
            "Boolean" => SimpleTypeKind::Boolean,
            "String" => SimpleTypeKind::String,
            "Enumeration" => {
                let quantity = fields.text("quantity");
                fields.finish(&mut self.xml);
                let mut items = Vec::new();
                self.list(start, "Item", |read, item| {
                    let mut fields = Fields::of(item);
                    items.push(EnumerationItem {
                        name: fields.required("name")?,
                        value: fields.int("value")?.ok_or_else(|| fields.missing("value"))?,
                        description: fields.text("description"),
                    });
                    fields.finish(&mut read.xml);
                    read.leaf(item)
                })?;
                return Ok(Some(SimpleTypeKind::Enumeration { quantity, items }));
            }
            _ => {
                self.unknown(start)?;
                return Ok(None);
            }
        };
        fields.finish(&mut self.xml);
        self.leaf(start)?;
        Ok(Some(kind))
    }

    pub(super) fn category(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let mut fields = Fields::of(start);
        let category =
            LogCategory { name: fields.required("name")?, description: fields.text("description") };
        fields.finish(&mut self.xml);
        self.lines.log_categories.push(start.line);
        self.description.log_categories.push(category);
        self.leaf(start)
    }

    pub(super) fn default_experiment(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let mut fields = Fields::of(start);
        self.lines.default_experiment = start.line;
        self.description.default_experiment = Some(DefaultExperiment {
            start_time: fields.double("startTime")?,
            stop_time: fields.double("stopTime")?,
            tolerance: fields.double("tolerance")?,
            step_size: fields.double("stepSize")?,
        });
        fields.finish(&mut self.xml);
        self.leaf(start)
    }

    /// `VendorAnnotations` and `Annotations`: only the tools' names are read.
    pub(super) fn annotations(&mut self, start: &mut Start) -> Result<(), ReadError> {
        let mut names = BTreeSet::new();
        self.list(start, "Tool", |read, tool| {
            let name = Fields::of(tool).required("name")?;
            if !names.insert(name.clone()) {
                let message = format!("tool `{name}` stands twice in one list; allowed is once");
                read.xml.warn(Code::DuplicateTool, tool.line, &tool.name, message);
            }
            read.xml.skip(tool)
        })
    }
}

/// The attributes that Real types and Real variables share.
pub(super) fn real_attributes(fields: &mut Fields) -> Result<RealAttributes, ReadError> {
    Ok(RealAttributes {
        quantity: fields.text("quantity"),
        unit: fields.text("unit"),
        display_unit: fields.text("displayUnit"),
        relative_quantity: fields.flag("relativeQuantity")?,
        min: fields.double("min")?,
        max: fields.double("max")?,
        nominal: fields.double("nominal")?,
        unbounded: fields.flag("unbounded")?,
    })
}
