//! The faults of the corpus: file name and the edits that turn `valid.xml` into it.

/// File name without extension, and what is replaced by what.
type Fault = (&'static str, &'static [(&'static str, &'static str)]);

const COUNT: &str = r#"valueReference="0" causality="output" variability="discrete">
      <Integer/>"#;
const DISTANCE: &str = r#"valueReference="2" causality="output">
      <Real unit="m"/>"#;
const END: &str = "  </ModelVariables>";
const GAIN: &str = r#"<Real min="0" max="10" nominal="2" start="3"/>"#;
const LIMIT: &str = r#"<Integer min="0" max="10" start="5"/>"#;
const POSITION: &str = r#"<Real declaredType="Length" displayUnit="km" start="1"/>"#;
const RATIO: &str = r#"causality="calculatedParameter" variability="fixed">
      <Real/>"#;
const TIME: &str = r#"<Real unit="s"/>"#;
const IDENTIFIER: &str = r#"<CoSimulation modelIdentifier="Valid""#;
const MODEL_EXCHANGE: &str = r#"<ModelExchange modelIdentifier="Valid"/>
  <CoSimulation modelIdentifier="Valid""#;

/// Every fault, in the order of the codes.
pub const FAULTS: &[Fault] = &[
    (
        "encoding--declared",
        &[("encoding=\"UTF-8\"", "encoding=\"ISO-8859-1\""), ("One of", "Ein St\u{fc}ck von")],
    ),
    ("malformed--cut-off", &[("</fmiModelDescription>\n", "")]),
    ("malformed--end-tag", &[("</UnitDefinitions>", "</Units>")]),
    ("malformed--entity", &[("One of everything", "One of &everything;")]),
    ("malformed--attribute-twice", &[("<BaseUnit m=\"1\"/>", "<BaseUnit m=\"1\" m=\"2\"/>")]),
    (
        "too-large--attributes",
        &[(
            "<Tool name=\"one\"/>",
            concat!(
                "<Tool name=\"one\"",
                " a0=\"\" a1=\"\" a2=\"\" a3=\"\" a4=\"\" a5=\"\" a6=\"\" a7=\"\" a8=\"\" a9=\"\"",
                " b0=\"\" b1=\"\" b2=\"\" b3=\"\" b4=\"\" b5=\"\" b6=\"\" b7=\"\" b8=\"\" b9=\"\"",
                " c0=\"\" c1=\"\" c2=\"\" c3=\"\" c4=\"\" c5=\"\" c6=\"\" c7=\"\" c8=\"\" c9=\"\"",
                " d0=\"\" d1=\"\" d2=\"\" d3=\"\" d4=\"\" d5=\"\" d6=\"\" d7=\"\" d8=\"\" d9=\"\"",
                " e0=\"\" e1=\"\" e2=\"\" e3=\"\" e4=\"\" e5=\"\" e6=\"\" e7=\"\" e8=\"\" e9=\"\"",
                " f0=\"\" f1=\"\" f2=\"\" f3=\"\" f4=\"\" f5=\"\" f6=\"\" f7=\"\" f8=\"\" f9=\"\"",
                " g0=\"\" g1=\"\" g2=\"\" g3=\"\" g4=\"\" g5=\"\" g6=\"\" g7=\"\" g8=\"\" g9=\"\"/>"
            ),
        )],
    ),
    (
        "root",
        &[("<fmiModelDescription", "<modelDescription"), ("</fmiModelDescription", "</modelDescription")],
    ),
    ("version--three", &[("fmiVersion=\"2.0\"", "fmiVersion=\"3.0\"")]),
    ("version--revision", &[("fmiVersion=\"2.0\"", "fmiVersion=\"2.0.5\"")]),
    ("missing-element--base-type", &[("      <Boolean/>\n", "")]),
    ("missing-element--model-structure", &[("<ModelStructure>", "<!--"), ("</ModelStructure>", "-->")]),
    ("duplicate-element--base-type", &[("<Boolean/>", "<Boolean/>\n      <Integer/>")]),
    ("missing-attribute--guid", &[(" guid=\"{5f7c0a52-0000-4000-8000-000000000000}\"", "")]),
    ("missing-attribute--value-reference", &[(" valueReference=\"6\"", "")]),
    ("missing-attribute--declared-type", &[("<Enumeration declaredType=\"Mode\"", "<Enumeration")]),
    ("bad-value--causality", &[("causality=\"input\"", "causality=\"Input\"")]),
    ("bad-value--double", &[(POSITION, "<Real declaredType=\"Length\" displayUnit=\"km\" start=\"1,0\"/>")]),
    (
        "bad-value--infinity",
        &[(POSITION, "<Real declaredType=\"Length\" displayUnit=\"km\" max=\"inf\" start=\"1\"/>")],
    ),
    ("bad-value--int", &[(LIMIT, "<Integer min=\"0\" max=\"2147483648\" start=\"5\"/>")]),
    ("bad-value--boolean", &[("canSerializeFMUstate=\"true\"", "canSerializeFMUstate=\"True\"")]),
    ("bad-value--negative-reference", &[("valueReference=\"7\"", "valueReference=\"-7\"")]),
    ("bad-value--dependency-kind", &[("\"dependent fixed\"", "\"dependent linear\"")]),
    (
        "element-order",
        &[
            ("<ModelVariables>", "<Moved>"),
            ("</ModelVariables>", "</Moved>"),
            (
                "<VendorAnnotations>\n    <Tool name=\"one\"/>\n    <Tool name=\"two\"/>\n  </VendorAnnotations>\n  <Moved>",
                "<ModelVariables>",
            ),
            (
                "</Moved>",
                "</ModelVariables>\n  <VendorAnnotations>\n    <Tool name=\"one\"/>\n  </VendorAnnotations>",
            ),
        ],
    ),
    ("empty-list", &[("<File name=\"a.c\"/>", ""), ("<File name=\"b.c\"/>", "")]),
    ("unknown-element", &[("<LogCategories>", "<Clocks/>\n  <LogCategories>")]),
    ("unknown-attribute", &[("causality=\"input\"", "causality=\"input\" clocks=\"1\"")]),
    ("unexpected-text", &[("<LogCategories>", "<LogCategories>all of them")]),
    ("duplicate-tool", &[("<Tool name=\"two\"/>", "<Tool name=\"one\"/>")]),
    ("no-interface", &[("<CoSimulation", "<!-- <CoSimulation"), ("</CoSimulation>", "</CoSimulation> -->")]),
    ("empty-text", &[("modelName=\"Valid\"", "modelName=\"\"")]),
    ("illegal-character", &[("One of everything", "One of &#1;everything")]),
    ("date-time", &[("2026-01-02T03:04:05Z", "2026-02-30T03:04:05Z")]),
    ("model-identifier--digit", &[(IDENTIFIER, "<CoSimulation modelIdentifier=\"2Valid\"")]),
    ("model-identifier--hyphen", &[(IDENTIFIER, "<CoSimulation modelIdentifier=\"Va-lid\"")]),
    ("serialize-without-state", &[(" canGetAndSetFMUstate=\"true\"", "")]),
    ("duplicate-source-file", &[("<File name=\"b.c\"/>", "<File name=\"a.c\"/>")]),
    ("duplicate-unit", &[("<Unit name=\"s\">", "<Unit name=\"s\"/>\n    <Unit name=\"s\">")]),
    ("duplicate-display-unit", &[("<DisplayUnit name=\"mm\"", "<DisplayUnit name=\"km\"")]),
    ("unit-conversion--zero", &[("factor=\"1000\"", "factor=\"0\"")]),
    ("unit-conversion--infinite", &[("<BaseUnit s=\"1\"/>", "<BaseUnit s=\"1\" offset=\"INF\"/>")]),
    ("undefined-unit--variable", &[(TIME, "<Real unit=\"sec\"/>")]),
    ("undefined-unit--one", &[(GAIN, "<Real unit=\"1\" start=\"3\"/>")]),
    (
        "undefined-unit--type",
        &[
            (
                "<Real unit=\"m\" min=\"-100\" max=\"100\"/>",
                "<Real unit=\"metre\" min=\"-100\" max=\"100\"/>",
            ),
            (" displayUnit=\"km\"", ""),
        ],
    ),
    (
        "undefined-display-unit",
        &[(
            DISTANCE,
            "valueReference=\"2\" causality=\"output\">\n      <Real unit=\"m\" displayUnit=\"AU\"/>",
        )],
    ),
    ("display-unit-without-unit", &[(GAIN, "<Real displayUnit=\"km\" start=\"3\"/>")]),
    (
        "duplicate-type",
        &[(
            "<SimpleType name=\"Mode\">",
            "<SimpleType name=\"Length\">\n      <Real unit=\"m\" min=\"-100\" max=\"100\"/>\n    </SimpleType>\n    <SimpleType name=\"Mode\">",
        )],
    ),
    (
        "type-name-is-variable",
        &[(
            "<SimpleType name=\"Mode\">",
            "<SimpleType name=\"gain\">\n      <Boolean/>\n    </SimpleType>\n    <SimpleType name=\"Mode\">",
        )],
    ),
    (
        "enumeration-empty",
        &[(
            "<SimpleType name=\"Mode\">",
            "<SimpleType name=\"Empty\">\n      <Enumeration/>\n    </SimpleType>\n    <SimpleType name=\"Mode\">",
        )],
    ),
    ("duplicate-item--name", &[("<Item name=\"fast\"", "<Item name=\"slow\"")]),
    ("duplicate-item--value", &[("<Item name=\"fast\" value=\"2\"", "<Item name=\"fast\" value=\"1\"")]),
    ("duplicate-category", &[("<Category name=\"logStatusError\"/>", "<Category name=\"logEvents\"/>")]),
    ("min-above-max--variable", &[(LIMIT, "<Integer min=\"10\" max=\"0\" start=\"5\"/>")]),
    ("min-above-max--type", &[("min=\"-100\" max=\"100\"", "min=\"100\" max=\"-100\"")]),
    ("limit-not-a-number", &[(GAIN, "<Real min=\"NaN\" max=\"10\" start=\"3\"/>")]),
    ("nominal--zero", &[(GAIN, "<Real nominal=\"0\" start=\"3\"/>")]),
    ("nominal--negative", &[(GAIN, "<Real nominal=\"-2\" start=\"3\"/>")]),
    ("stop-before-start", &[("startTime=\"0\"", "startTime=\"20\"")]),
    ("step-size--zero", &[("stepSize=\"0.1\"", "stepSize=\"0\"")]),
    ("step-size--negative", &[("stepSize=\"0.1\"", "stepSize=\"-0.1\"")]),
    ("tolerance", &[("tolerance=\"1e-6\"", "tolerance=\"0\"")]),
    ("experiment-time", &[("stopTime=\"10\"", "stopTime=\"INF\"")]),
    (
        "no-variables",
        &[
            ("  <ModelVariables>", "  <ModelVariables/>\n  <!--"),
            ("  </ModelVariables>", ""),
            ("  <ModelStructure>", ""),
            ("  </ModelStructure>", "  -->\n  <ModelStructure/>"),
        ],
    ),
    ("duplicate-name", &[("name=\"active\"", "name=\"gain\"")]),
    ("illegal-name--space", &[("name=\"active\"", "name=\"is active\"")]),
    ("illegal-name--index", &[("name=\"position[1]\"", "name=\"position[]\"")]),
    ("illegal-name--derivative-of-boolean", &[("name=\"active\"", "name=\"der(gain)\"")]),
    (
        "illegal-name--flat-line-feed",
        &[(" variableNamingConvention=\"structured\"", ""), ("name=\"active\"", "name=\"is&#10;active\"")],
    ),
    (
        "causality-variability--constant-input",
        &[("causality=\"input\"", "causality=\"input\" variability=\"constant\"")],
    ),
    (
        "causality-variability--continuous-parameter",
        &[(RATIO, "causality=\"calculatedParameter\">\n      <Real/>")],
    ),
    (
        "causality-variability--fixed-output",
        &[
            (
                DISTANCE,
                "valueReference=\"2\" causality=\"output\" variability=\"fixed\">\n      <Real unit=\"m\"/>",
            ),
            ("<Unknown index=\"3\" dependencies=\"2 11\"/>\n      ", ""),
        ],
    ),
    (
        "continuous-not-real--integer",
        &[(COUNT, "valueReference=\"0\" causality=\"output\">\n      <Integer/>")],
    ),
    (
        "continuous-not-real--integer-parameter",
        &[("causality=\"parameter\" variability=\"tunable\"", "causality=\"parameter\"")],
    ),
    ("initial-forbidden--input", &[("causality=\"input\"", "causality=\"input\" initial=\"exact\"")]),
    (
        "initial-forbidden--independent",
        &[("causality=\"independent\"", "causality=\"independent\" initial=\"calculated\"")],
    ),
    (
        "initial-not-allowed--parameter",
        &[(
            "causality=\"parameter\" variability=\"tunable\"",
            "causality=\"parameter\" variability=\"tunable\" initial=\"approx\"",
        )],
    ),
    (
        "initial-not-allowed--calculated-parameter",
        &[(
            RATIO,
            "causality=\"calculatedParameter\" variability=\"fixed\" initial=\"exact\">\n      <Real start=\"1\"/>",
        )],
    ),
    ("start-missing--input", &[(POSITION, "<Real declaredType=\"Length\" displayUnit=\"km\"/>")]),
    ("start-missing--parameter", &[("<String start=\"text\"/>", "<String/>")]),
    (
        "start-missing--approx",
        &[(
            RATIO,
            "causality=\"calculatedParameter\" variability=\"fixed\" initial=\"approx\">\n      <Real/>",
        )],
    ),
    (
        "start-forbidden--calculated",
        &[(RATIO, "causality=\"calculatedParameter\" variability=\"fixed\">\n      <Real start=\"1\"/>")],
    ),
    ("start-forbidden--independent", &[(TIME, "<Real unit=\"s\" start=\"0\"/>")]),
    ("start-out-of-range--above", &[(GAIN, "<Real min=\"0\" max=\"10\" nominal=\"2\" start=\"11\"/>")]),
    ("start-out-of-range--below", &[(LIMIT, "<Integer min=\"0\" max=\"10\" start=\"-1\"/>")]),
    (
        "start-out-of-range--type",
        &[(POSITION, "<Real declaredType=\"Length\" displayUnit=\"km\" start=\"101\"/>")],
    ),
    ("start-not-finite--nan", &[(GAIN, "<Real start=\"NaN\"/>")]),
    ("start-not-finite--infinite", &[(GAIN, "<Real start=\"INF\"/>")]),
    ("start-not-an-item", &[("declaredType=\"Mode\" start=\"1\"", "declaredType=\"Mode\" start=\"3\"")]),
    ("declared-type-undefined", &[("declaredType=\"Mode\"", "declaredType=\"Speed\"")]),
    ("declared-type-kind", &[("declaredType=\"Mode\"", "declaredType=\"Length\"")]),
    (
        "limits-beyond-type",
        &[(POSITION, "<Real declaredType=\"Length\" displayUnit=\"km\" max=\"200\" start=\"1\"/>")],
    ),
    (
        "several-independent",
        &[(
            END,
            "    <ScalarVariable name=\"clock\" valueReference=\"99\" causality=\"independent\">\n      <Real unit=\"s\"/>\n    </ScalarVariable>\n  </ModelVariables>",
        )],
    ),
    ("derivative-index--beyond", &[("derivative=\"12\"", "derivative=\"99\"")]),
    ("derivative-index--itself", &[("derivative=\"12\"", "derivative=\"13\"")]),
    ("derivative-kind", &[("derivative=\"12\"", "derivative=\"8\"")]),
    ("reinit--co-simulation", &[("<Real start=\"1\"/>", "<Real start=\"1\" reinit=\"true\"/>")]),
    ("reinit--no-state", &[(IDENTIFIER, MODEL_EXCHANGE), (GAIN, "<Real start=\"3\" reinit=\"true\"/>")]),
    (
        "multiple-set--co-simulation",
        &[("causality=\"input\"", "causality=\"input\" canHandleMultipleSetPerTimeInstant=\"true\"")],
    ),
    (
        "multiple-set--parameter",
        &[
            (IDENTIFIER, MODEL_EXCHANGE),
            (
                "causality=\"parameter\" variability=\"tunable\"",
                "causality=\"parameter\" variability=\"tunable\" canHandleMultipleSetPerTimeInstant=\"true\"",
            ),
        ],
    ),
    (
        "alias-start",
        &[(
            END,
            "    <ScalarVariable name=\"twin\" valueReference=\"6\" initial=\"exact\">\n      <Real start=\"1\"/>\n    </ScalarVariable>\n  </ModelVariables>",
        )],
    ),
    (
        "alias-settable",
        &[(
            END,
            "    <ScalarVariable name=\"twin\" valueReference=\"1\" causality=\"input\">\n      <Real unit=\"m\" start=\"1\"/>\n    </ScalarVariable>\n  </ModelVariables>",
        )],
    ),
    (
        "alias-constant--mixed",
        &[(
            END,
            "    <ScalarVariable name=\"twin\" valueReference=\"4\">\n      <Real/>\n    </ScalarVariable>\n  </ModelVariables>",
        )],
    ),
    (
        "alias-constant--values",
        &[(
            END,
            "    <ScalarVariable name=\"twin\" valueReference=\"4\" variability=\"constant\">\n      <Real start=\"3.15\"/>\n    </ScalarVariable>\n  </ModelVariables>",
        )],
    ),
    (
        "alias-unit",
        &[(
            END,
            "    <ScalarVariable name=\"twin\" valueReference=\"2\">\n      <Real unit=\"s\"/>\n    </ScalarVariable>\n  </ModelVariables>",
        )],
    ),
    (
        "structure-index--zero",
        &[(
            "<Unknown index=\"4\" dependencies=\"\"/>",
            "<Unknown index=\"4\" dependencies=\"\"/>\n      <Unknown index=\"0\"/>",
        )],
    ),
    (
        "structure-index--beyond",
        &[(
            "<Unknown index=\"4\" dependencies=\"\"/>",
            "<Unknown index=\"4\" dependencies=\"\"/>\n      <Unknown index=\"99\"/>",
        )],
    ),
    (
        "structure-duplicate--outputs",
        &[(
            "<Unknown index=\"4\" dependencies=\"\"/>",
            "<Unknown index=\"4\" dependencies=\"\"/>\n      <Unknown index=\"4\"/>",
        )],
    ),
    (
        "structure-duplicate--initial-unknowns",
        &[("<Unknown index=\"7\"/>", "<Unknown index=\"7\"/>\n      <Unknown index=\"7\"/>")],
    ),
    ("output-missing", &[("      <Unknown index=\"4\" dependencies=\"\"/>\n", "")]),
    (
        "output-extra",
        &[(
            "<Unknown index=\"4\" dependencies=\"\"/>",
            "<Unknown index=\"4\" dependencies=\"\"/>\n      <Unknown index=\"9\"/>",
        )],
    ),
    (
        "derivative-entry",
        &[(
            "<Unknown index=\"13\" dependencies=\"2\"/>",
            "<Unknown index=\"13\" dependencies=\"2\"/>\n      <Unknown index=\"12\"/>",
        )],
    ),
    (
        "derivative-unlisted",
        &[
            (IDENTIFIER, MODEL_EXCHANGE),
            ("<Derivatives>\n      <Unknown index=\"13\" dependencies=\"2\"/>\n    </Derivatives>", ""),
            ("<Unknown index=\"13\"/>", ""),
        ],
    ),
    ("initial-unknown-missing--output", &[("      <Unknown index=\"4\"/>\n", "")]),
    ("initial-unknown-missing--derivative", &[("      <Unknown index=\"13\"/>\n", "")]),
    (
        "initial-unknown-extra",
        &[("<Unknown index=\"7\"/>", "<Unknown index=\"7\"/>\n      <Unknown index=\"11\"/>")],
    ),
    (
        "initial-unknown-order",
        &[(
            "<Unknown index=\"4\"/>\n      <Unknown index=\"7\"/>",
            "<Unknown index=\"7\"/>\n      <Unknown index=\"4\"/>",
        )],
    ),
    ("dependency-index--zero", &[("dependencies=\"2 11\"", "dependencies=\"0 2\"")]),
    ("dependency-index--beyond", &[("dependencies=\"2 11\"", "dependencies=\"2 99\"")]),
    ("dependency-order", &[("dependencies=\"2 11\"", "dependencies=\"11 2\"")]),
    (
        "dependency-known",
        &[("<Unknown index=\"13\" dependencies=\"2\"/>", "<Unknown index=\"13\" dependencies=\"2 3\"/>")],
    ),
    ("dependency-kind-count", &[("\"dependent fixed\"", "\"dependent\"")]),
    (
        "dependency-kind-alone",
        &[("<Unknown index=\"7\"/>", "<Unknown index=\"7\" dependenciesKind=\"dependent\"/>")],
    ),
    (
        "dependency-kind-initial",
        &[("dependencies=\"2 11\"", "dependencies=\"2 11\" dependenciesKind=\"dependent tunable\"")],
    ),
    (
        "dependency-kind-real",
        &[(
            "<Unknown index=\"4\" dependencies=\"\"/>",
            "<Unknown index=\"4\" dependencies=\"2\" dependenciesKind=\"constant\"/>",
        )],
    ),
];
