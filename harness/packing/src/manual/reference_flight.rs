//! How the FMU's reference flight is simulated again.

use model_description::{Description, escape};

use super::section::Section;

/// The section; none for an FMU that cannot be stepped.
pub(super) fn section(description: &Description) -> Option<Section> {
    let name = &description.co_simulation.as_ref()?.model_identifier;
    let code = format!(
        "from fmpy import extract, read_csv, simulate_fmu\n\
         from pathlib import Path\n\n\
         folder = Path(extract(\"{name}.fmu\")) / \"{}\"\n\
         expected = read_csv(folder / \"{name}_out.csv\")\n\
         inputs = folder / \"{name}_in.csv\"\n\
         time, names = expected[\"time\"], [name for name in expected.dtype.names if name != \"time\"]\n\
         found = simulate_fmu(\"{name}.fmu\", start_time=time[0], stop_time=time[-1], step_size=time[1] - time[0],\n    \
         output_interval=time[1] - time[0], input=read_csv(inputs) if inputs.exists() else None, output=names)\n\
         vector = lambda name: name[:name.rindex(\"[\")] if name.endswith(\"]\") else name\n\
         size = {{}}\n\
         for name in names:\n    \
         size[vector(name)] = max(size.get(vector(name), 0.0), abs(expected[name]).max())\n\
         off = [abs(found[name] - expected[name]).max() / (size[vector(name)] or 1.0) for name in names]\n\
         print(\"largest deviation:\", max(off))\n",
        fmi::reference::FOLDER
    );
    let content = format!(
        "<p>The FMU carries a short flight in <code>{}</code>, in the layout of FMI-LS-REF: inputs and outputs as CSV, with the tolerance \
         in the manifest. <code>heliotorque check</code> simulates it again, and so does FMPy:</p>\n<pre><code>{}</code></pre>\n",
        fmi::reference::FOLDER,
        escape(&code)
    );
    Some(("reference", "Reference flight", content))
}
