//! Annotations of a variable: what cannot be read gives a warning and is left out, for a simulation does not need it.

use super::Read;
use super::xml::Start;
use crate::Annotation;
use crate::annotation::TOOL;
use crate::element::{Element, ReadError};
use crate::finding::Code;

impl Read<'_> {
    /// The annotation of a variable of this name.
    pub(super) fn annotation(
        &mut self,
        tool: &Start,
        variable: &str,
    ) -> Result<Option<Box<Annotation>>, ReadError> {
        let mut found = None;
        while let Some(mut child) = self.xml.child(tool)? {
            let annotation: Option<Annotation> = self.annotated(&mut child, "Variable", variable);
            let mut read_where = Vec::new();
            while let Some(mut option) = self.xml.child(&child)? {
                read_where.extend(self.annotated(&mut option, "ReadWhere", variable));
                self.xml.skip(&option)?;
            }
            found = found.or(annotation.map(|it| Box::new(Annotation { read_where, ..it })));
        }
        if found.is_some() {
            self.description.annotation_tool = Some(TOOL.to_owned());
        }
        Ok(found)
    }

    /// The attributes of an element of this name.
    fn annotated<T: Element>(&mut self, start: &mut Start, name: &str, variable: &str) -> Option<T> {
        let mut fields = start.fields();
        let read = match start.name == name {
            true => T::read(&mut fields).map_err(|error| error.message),
            false => Err(format!("allowed is <{name}>")),
        };
        let unknown = fields.unknown().map(|name| format!("attribute `{name}` is not known"));
        let problems: Vec<String> = match &read {
            Ok(_) => unknown.collect(),
            Err(problem) => vec![problem.clone()],
        };
        for problem in problems {
            let message = format!("annotation of `{variable}`: {problem}; it is ignored");
            self.xml.warn(Code::Annotation, start.line, &start.name, message);
        }
        read.ok()
    }
}
