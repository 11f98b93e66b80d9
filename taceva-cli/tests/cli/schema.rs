//! Published JSON schemas, and a checker for the keywords that they use.

use serde_json::Value;

/// Fails unless `found` matches `docs/schema/<name>.json`.
pub(crate) fn check(name: &str, found: &Value) {
    let path = format!("{}/../docs/schema/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the schema is there");
    let schema: Value = serde_json::from_str(&text).expect("JSON");
    if let Err(problem) = meets(found, &schema, &schema, "$") {
        panic!("{name}: {problem}");
    }
}

/// Keywords of JSON Schema that the test checks, and keywords that only describe.
const KNOWN: [&str; 15] = [
    "$schema",
    "$id",
    "$defs",
    "$ref",
    "title",
    "description",
    "type",
    "const",
    "enum",
    "minimum",
    "maximum",
    "anyOf",
    "required",
    "properties",
    "additionalProperties",
];

fn meets(found: &Value, schema: &Value, root: &Value, at: &str) -> Result<(), String> {
    let schema = match schema {
        Value::Bool(true) => return Ok(()),
        Value::Bool(false) => return Err(format!("{at} should not be there")),
        schema => schema,
    };
    for keyword in schema.as_object().expect("a schema").keys() {
        assert!(
            KNOWN.contains(&keyword.as_str()) || keyword == "items",
            "`{keyword}` is not looked at"
        );
    }
    if let Some(reference) = schema["$ref"].as_str() {
        let name = reference.strip_prefix("#/$defs/").expect("of this file");
        meets(found, &root["$defs"][name], root, at)?;
    }
    if let Some(kind) = schema["type"].as_str() {
        let is_one = match kind {
            "object" => found.is_object(),
            "array" => found.is_array(),
            "string" => found.is_string(),
            "number" => found.is_number(),
            "integer" => found.is_u64() || found.is_i64(),
            "boolean" => found.is_boolean(),
            "null" => found.is_null(),
            other => panic!("`{other}` is no type"),
        };
        if !is_one {
            return Err(format!("{at} should be of type {kind}, found {found}"));
        }
    }
    if let Some(only) = schema.get("const").filter(|only| *only != found) {
        return Err(format!("{at} should be {only}, found {found}"));
    }
    if let Some(listed) = schema["enum"]
        .as_array()
        .filter(|listed| !listed.contains(found))
    {
        return Err(format!("{at} should be one of {listed:?}, found {found}"));
    }
    let is_beyond = |least: bool| {
        let end = schema[if least { "minimum" } else { "maximum" }].as_f64();
        let number = found.as_f64();
        end.zip(number)
            .is_some_and(|(end, number)| if least { number < end } else { number > end })
    };
    if is_beyond(true) || is_beyond(false) {
        return Err(format!("{at} should be in its range, found {found}"));
    }
    if let Some(choices) = schema["anyOf"].as_array() {
        let problems: Vec<String> = choices
            .iter()
            .filter_map(|choice| meets(found, choice, root, at).err())
            .collect();
        if problems.len() == choices.len() {
            return Err(problems.join(", or "));
        }
    }
    for (index, item) in found.as_array().into_iter().flatten().enumerate() {
        if let Some(items) = schema.get("items") {
            meets(item, items, root, &format!("{at}[{index}]"))?;
        }
    }
    for name in schema["required"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
    {
        if found.get(name).is_none() {
            return Err(format!("{at}.{name} is missing"));
        }
    }
    for (key, value) in found.as_object().into_iter().flatten() {
        let of_key = schema["properties"]
            .get(key)
            .or_else(|| schema.get("additionalProperties"));
        if let Some(of_key) = of_key {
            meets(value, of_key, root, &format!("{at}.{key}"))?;
        }
    }
    Ok(())
}
