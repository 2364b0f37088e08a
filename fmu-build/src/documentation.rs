//! documentation/index.html: a written page, with the tables of variables taken from
//! modelDescription.xml.

use crate::table_cells::{array_meaning, short_number, unit_cell};
use anyhow::{Context, Result};
use quick_xml::escape::escape;
use roxmltree::{Document, Node};

/// The page, with `{{variables}}` and `{{version}}` to be filled in.
const PAGE: &str = include_str!("../assets/documentation/index.html");

/// Causalities in the order of the page, with their headings.
const SECTIONS: [(&str, &str); 5] = [
    ("input", "Inputs"),
    ("output", "Outputs"),
    ("parameter", "Parameters"),
    ("calculatedParameter", "Calculated parameters"),
    ("local", "Local variables"),
];

/// The page for a model description.
pub(crate) fn page(description: &str) -> Result<String> {
    let document = Document::parse(description).context("modelDescription.xml is not well-formed")?;
    let root = document.root_element();
    let variables: Vec<Row> = root
        .descendants()
        .filter(|node| node.has_tag_name("ScalarVariable"))
        .filter_map(|node| Row::of(root, node))
        .collect();
    let tables: String =
        SECTIONS.iter().map(|(causality, heading)| table(heading, causality, &variables)).collect();
    let version = root.attribute("version").unwrap_or(env!("CARGO_PKG_VERSION"));
    Ok(PAGE.replace("{{variables}}", &tables).replace("{{version}}", &escape(version)))
}

/// One variable, or the first of an array.
struct Row {
    causality: String,
    name: String,
    unit: String,
    start: String,
    description: String,
    /// Number, name and meaning of the values of an enumeration.
    items: Vec<[String; 3]>,
}

impl Row {
    /// `None` for the further elements of an array, which share the row of the first.
    fn of(root: Node<'_, '_>, variable: Node<'_, '_>) -> Option<Self> {
        let text = |node: Node<'_, '_>, key: &str| node.attribute(key).unwrap_or_default().to_owned();
        let name = match variable.attribute("name")?.split_once('[') {
            Some((array, "1]")) => format!("{array}[1] … {array}[{}]", array_length(root, array)),
            Some(_) => return None,
            None => text(variable, "name"),
        };
        let element = variable.children().find(Node::is_element)?;
        let declared = element.attribute("declaredType").and_then(|name| declared_type(root, name));
        let unit = element.attribute("unit").or_else(|| declared?.attribute("unit"));
        let start = match declared {
            Some(declared) if declared.has_tag_name("Enumeration") => {
                item_name(declared, &text(element, "start"))
            }
            _ => start_cell(&text(element, "start")),
        };
        let items = declared.into_iter().flat_map(|declared| declared.children());
        let items = items.filter(|node| node.has_tag_name("Item"));
        Some(Self {
            causality: variable.attribute("causality").unwrap_or("local").to_owned(),
            name,
            unit: unit_cell(unit.unwrap_or_default()),
            start,
            description: array_meaning(&text(variable, "description")),
            items: items.map(|item| ["value", "name", "description"].map(|key| text(item, key))).collect(),
        })
    }
}

fn table(heading: &str, causality: &str, variables: &[Row]) -> String {
    let rows: String = variables
        .iter()
        .filter(|row| row.causality == causality)
        .map(|row| {
            let cells = [&row.unit, &row.start].map(|text| format!("<td>{}</td>", escape(text)));
            let meaning = escape(&row.description).into_owned() + &values(&row.items);
            format!(
                "<tr><td><code>{}</code></td>{}<td>{meaning}</td></tr>\n",
                escape(&row.name),
                cells.concat()
            )
        })
        .collect();
    if rows.is_empty() {
        return rows;
    }
    let head = "<tr><th>Name</th><th>Unit</th><th>Default</th><th>Meaning</th></tr>";
    format!("<h3>{heading}</h3>\n<table>\n{head}\n{rows}</table>\n")
}

/// The values of an enumeration as a list; nothing for other types.
fn values(items: &[[String; 3]]) -> String {
    if items.is_empty() {
        return String::new();
    }
    let lines = items.iter().map(|item| {
        let [number, name, meaning] = item.each_ref().map(escape);
        let meaning = if meaning.is_empty() { meaning } else { format!(": {meaning}").into() };
        format!("<li>{number} = <code>{name}</code>{meaning}</li>")
    });
    format!("<ul class=\"values\">{}</ul>", lines.collect::<String>())
}

fn array_length(root: Node<'_, '_>, array: &str) -> usize {
    let start = format!("{array}[");
    let mut names = root
        .descendants()
        .filter_map(|node| if node.has_tag_name("ScalarVariable") { node.attribute("name") } else { None });
    names.by_ref().filter(|name| name.starts_with(&start)).count()
}

fn declared_type<'a, 'input>(root: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    let mut types = root.descendants().filter(|node| node.has_tag_name("SimpleType"));
    types.find(|node| node.attribute("name") == Some(name))?.children().find(Node::is_element)
}

/// The name of an enumeration's item, or the value if it has none.
fn item_name(enumeration: Node<'_, '_>, value: &str) -> String {
    let mut items = enumeration.children().filter(|node| node.has_tag_name("Item"));
    let item = items.find(|item| item.attribute("value") == Some(value));
    item.and_then(|item| item.attribute("name")).unwrap_or(value).to_owned()
}

/// A short number; any other text as it is.
fn start_cell(text: &str) -> String {
    text.parse().map_or_else(|_| text.to_owned(), short_number)
}

#[cfg(test)]
mod tests {
    use super::{page, start_cell};

    const DESCRIPTION: &str = r#"<fmiModelDescription version="1.2.3">
<TypeDefinitions><SimpleType name="Shape"><Enumeration><Item name="cone" value="2" description="f &lt; r"/></Enumeration></SimpleType></TypeDefinitions>
<ModelVariables>
<ScalarVariable name="load" causality="input" description="a &lt; b"><Real unit="N" start="1000.0"/></ScalarVariable>
<ScalarVariable name="shape" causality="parameter"><Enumeration declaredType="Shape" start="2"/></ScalarVariable>
<ScalarVariable name="p[1]" causality="local" description="at r[1]"><Real unit="Pa"/></ScalarVariable>
<ScalarVariable name="p[2]" causality="local"><Real unit="Pa"/></ScalarVariable>
</ModelVariables></fmiModelDescription>"#;

    #[test]
    fn variables_are_listed_with_unit_default_and_meaning() {
        let page = page(DESCRIPTION).unwrap();
        assert!(
            page.contains("<tr><td><code>load</code></td><td>N</td><td>1000</td><td>a &lt; b</td></tr>"),
            "{page}"
        );
        assert!(page.contains("<code>shape</code></td><td></td><td>cone</td>"), "{page}");
        let values = "<td><ul class=\"values\"><li>2 = <code>cone</code>: f &lt; r</li></ul></td>";
        assert!(page.contains(values), "{page}");
        assert!(page.contains("1.2.3") && !page.contains("{{"), "{page}");
    }

    #[test]
    fn an_array_takes_one_row() {
        let page = page(DESCRIPTION).unwrap();
        assert!(page.contains("<code>p[1] … p[2]</code></td><td>Pa</td><td></td><td>at r</td>"), "{page}");
        assert!(!page.contains("<code>p[2]"), "{page}");
    }

    #[test]
    fn numbers_are_short_and_texts_stay() {
        let shown = ["210000000000.0", "0.0", "128", "C:/profile.txt"].map(start_cell);
        assert_eq!(shown, ["2.1e11", "0", "128", "C:/profile.txt"]);
    }
}
