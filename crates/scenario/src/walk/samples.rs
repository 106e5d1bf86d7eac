//! Values that fit a schema, for tests: of every object all that it must have, and each of its parts in every documented
//! form.

use serde_json::{Map, Value, json};

use super::branch::{branches, types};

/// Values that together have every branch, constant and key of `schema`; the first has the least.
pub fn samples(root: &Value, schema: &Value) -> Vec<Value> {
    let target = schema["$ref"].as_str().and_then(|name| root.pointer(name.strip_prefix('#')?));
    let schema = target.unwrap_or(schema);
    if let Some(constant) = schema.get("const") {
        return vec![constant.clone()];
    }
    if let Some(allowed) = schema["enum"].as_array() {
        return allowed.clone();
    }
    if let Some(branches) = branches(schema) {
        return branches.iter().flat_map(|branch| samples(root, branch)).collect();
    }
    let of_type = |kind: &str| match kind {
        "object" => objects(root, schema),
        "array" => arrays(root, schema),
        "number" => vec![json!(number(schema))],
        "integer" => vec![json!(number(schema).ceil() as i64)],
        "string" => vec![json!("a")],
        "boolean" => vec![json!(true), json!(false)],
        _ => vec![Value::Null],
    };
    types(schema).flat_map(of_type).collect()
}

fn objects(root: &Value, schema: &Value) -> Vec<Value> {
    let Some(properties) = schema["properties"].as_object() else { return vec![json!({})] };
    let required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let least: Map<String, Value> =
        required.map(|key| (key.to_owned(), samples(root, &properties[key])[0].clone())).collect();
    let with = |(key, property): (&String, &Value)| {
        let each = samples(root, property).into_iter();
        let set = |value| least.iter().map(|(k, v)| (k.clone(), v.clone())).chain([(key.clone(), value)]).collect();
        each.map(set).map(Value::Object).collect::<Vec<_>>()
    };
    let all = properties.iter().flat_map(with);
    std::iter::once(Value::Object(least.clone())).chain(all).collect()
}

fn arrays(root: &Value, schema: &Value) -> Vec<Value> {
    let tuple = schema["prefixItems"].as_array();
    let entries: Vec<Vec<Value>> = match tuple {
        Some(each) => each.iter().map(|item| samples(root, item)).collect(),
        None => vec![samples(root, &schema["items"]); schema["minItems"].as_u64().unwrap_or(1).max(1) as usize],
    };
    let least: Vec<Value> = entries.iter().map(|entry| entry[0].clone()).collect();
    let changed = |i: usize| if tuple.is_some() || i == 0 { &entries[i][..] } else { &[] };
    let with = |(i, value): (usize, &Value)| {
        let mut list = least.clone();
        list[i] = value.clone();
        Value::Array(list)
    };
    (0..entries.len()).flat_map(|i| changed(i).iter().map(move |value| (i, value))).map(with).collect()
}

/// A number within the limits.
fn number(schema: &Value) -> f64 {
    let limit = |keyword: &str| schema[keyword].as_f64();
    match (limit("exclusiveMinimum"), limit("minimum"), limit("maximum")) {
        (Some(low), _, Some(high)) => 0.5 * (low + high),
        (Some(low), _, None) => low + 1.0,
        (None, Some(low), _) => low,
        (None, None, high) => high.unwrap_or(1.0),
    }
}
