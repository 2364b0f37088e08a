//! XML documents in memory.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::io;

pub(crate) type Xml = Writer<Vec<u8>>;

/// A document of one element with some attributes; `content` writes what is inside.
pub(crate) fn document<'a>(
    element: &str,
    attributes: impl IntoIterator<Item = (&'a str, &'a str)>,
    content: impl FnOnce(&mut Xml) -> io::Result<()>,
) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))
        .expect("memory takes everything");
    xml.create_element(element)
        .with_attributes(attributes)
        .write_inner_content(content)
        .expect("memory takes everything");
    let mut text = String::from_utf8(xml.into_inner()).expect("the writer makes UTF-8");
    text.push('\n');
    text
}
