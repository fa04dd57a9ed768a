//! Communication steps in annotations, for SSP has no place of its own: ours, OSP's, OMSimulator's.

use files::ANNOTATION;
use model_description::{ReadError, Start, Xml};

use crate::elements::{list, number, refuse};

/// Types of annotations with the elements in them that have a step and the attributes that say it in s, the one that wins first.
const STEPS: [(&str, &str, &str); 5] = [
    (ANNOTATION, "Step", "size"),
    ("com.opensimulationplatform", "FixedStepAlgorithm", "baseStepSize"),
    ("com.opensimulationplatform", "FixedStepMaster", "baseStepSize"),
    ("org.open-simulation-platform", "FixedStepMaster", "stepSize"),
    ("org.openmodelica", "FixedStepMaster", "stepSize"),
];

/// The step of the first kind that is annotated, in s.
#[derive(Debug, Default)]
pub(crate) struct AnnotatedStep(Option<(usize, f64)>);

impl AnnotatedStep {
    /// The step.
    pub(crate) fn step_s(&self) -> Option<f64> {
        self.0.map(|(_, step_s)| step_s)
    }

    /// Reads `Annotations` after their start tag.
    pub(crate) fn read(&mut self, xml: &mut Xml<'_>, start: &Start) -> Result<(), ReadError> {
        let annotation = |xml: &mut Xml<'_>, annotation: &Start| {
            let kind = annotation.attribute("type").unwrap_or_default().to_owned();
            if STEPS.iter().any(|(known, ..)| *known == kind) {
                self.within(xml, annotation, &kind)
            } else {
                xml.skip(annotation)
            }
        };
        list(xml, start, "Annotation", annotation).map(drop)
    }

    /// Finds steps at any depth; depth is bounded by the reader.
    fn within(&mut self, xml: &mut Xml<'_>, parent: &Start, kind: &str) -> Result<(), ReadError> {
        while let Some(child) = xml.child(parent)? {
            let known =
                STEPS.iter().enumerate().filter(|(_, (of, name, _))| *of == kind && child.local() == *name);
            for (rank, (.., key)) in known {
                let Some(step_s) = number(&child, key)? else { continue };
                if step_s <= 0.0 {
                    let found = child.attribute(key).unwrap_or_default();
                    let message =
                        format!("attribute `{key}`: found {found:?}, allowed: a number of seconds above 0");
                    return Err(refuse(&child, message));
                }
                if self.0.is_none_or(|(earlier, _)| rank < earlier) {
                    self.0 = Some((rank, step_s));
                }
            }
            self.within(xml, &child, kind)?;
        }
        Ok(())
    }
}
