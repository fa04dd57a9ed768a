//! Messages of an FMU's log.

use model_description::Status;

/// One message of an instance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogMessage {
    /// Status that goes with it; a number that FMI 2.0 does not have counts as `fmi2Error`.
    pub status: Status,
    /// Category, if the FMU names one.
    pub category: Option<String>,
    /// The text; `%%` and `##` unescaped.
    pub text: String,
}

/// The texts of the warnings among messages, each once.
pub fn warnings(messages: &[LogMessage]) -> Vec<&str> {
    let mut texts = Vec::new();
    for message in messages.iter().filter(|message| message.status == Status::Warning) {
        if !texts.contains(&message.text.as_str()) {
            texts.push(message.text.as_str());
        }
    }
    texts
}

impl std::fmt::Display for LogMessage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "[{}] {}", self.category.as_deref().unwrap_or("no category"), self.text)
    }
}
