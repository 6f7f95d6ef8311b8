//! MEI type 14 (0Eh): read device identification, who made the device and what it is, as texts.

use super::{Carried, Interface};
use crate::field::{Argument, Format, Message, Name, Role, Spec, escaped, hex_value};
use crate::message;
use crate::modbus::{Body, Choice, Length, Server};
use crate::walk::{Telegram, Walk, Walker};

pub(super) static INTERFACE: Interface = Interface {
    number: 14,
    spec: Spec::new("read_device_identification", "Read device identification")
        .note("Asks who made the device and what it is.")
        .source(SOURCE),
    request: Carried { length: Length::Fixed(4), new: || Box::new(Request { code: 1, object: 0 }) },
    response: Carried {
        length: Length::Listed { at: 6 },
        new: || Box::new(Response { code: 1, conformity: 1, more: 0, next: 0, objects: Vec::new() }),
    },
};

/// Code (1 byte), object ID (1 byte).
struct Request {
    code: u8,
    object: u8,
}

impl Telegram for Request {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&CODE, &mut self.code)?;
        w.u8(&FIRST, &mut self.object)
    }
}

impl Body for Request {
    fn meaning(&self, who: Server) -> Message {
        let (who, object) = (who.name(), object(self.object));
        match (CODE.name(self.code.into()), self.code) {
            (Some(_), ONE) => message!("ask {who} for its {object}", who = who, object = object),
            (Some(name), _) => message!(
                "ask {who} what it is: {category}, from {object} on",
                who = who,
                category = Argument::Term(name.label),
                object = object
            ),
            (None, code) => {
                message!("ask {who} what it is, with the undefined code {code}", who = who, code = code)
            }
        }
    }

    fn only_reads(&self) -> bool {
        true
    }
}

/// Code (1 byte), conformity level (1), more follows (1), next object (1), number of objects (1), then
/// the objects.
struct Response {
    code: u8,
    conformity: u8,
    more: u16,
    next: u8,
    objects: Vec<Object>,
}

/// ID (1 byte), length (1 byte), text.
#[derive(Default)]
struct Object {
    id: u8,
    text: Vec<u8>,
}

impl Telegram for Response {
    fn walk(&mut self, w: &mut dyn Walker) -> Walk {
        w.u8(&CODE, &mut self.code)?;
        w.u8(&CONFORMITY, &mut self.conformity)?;
        MORE.walk(w, &mut self.more)?;
        w.u8(&NEXT, &mut self.next)?;
        let count = w.announce(&COUNT, 1, self.objects.len(), 1)?;
        w.list(&OBJECTS, &mut self.objects, count, Some(1), |w, object| {
            w.within(&OBJECT, &mut |w| {
                w.u8(&ID, &mut object.id)?;
                let length = w.announce(&LENGTH, 1, object.text.len(), 1)?;
                w.bytes(&TEXT, &mut object.text, Some(length))
            })
        })
    }
}

impl Body for Response {
    fn meaning(&self, who: Server) -> Message {
        let said = self.objects.iter().map(|found| {
            message!("{object} “{text}”", object = object(found.id), text = escaped(&found.text))
        });
        match Message::list(said) {
            Some(said) => message!("{who} answers: {objects}", who = who.name(), objects = said),
            None => message!("{who} answers without an object", who = who.name()),
        }
    }
}

/// "vendor name", or "object 80h".
fn object(id: u8) -> Message {
    match ID.name(id.into()) {
        Some(name) => Message::term(name.label),
        None => message!("object {id}", id = hex_value(id.into(), 1)),
    }
}

/// The code that asks for a single object.
const ONE: u8 = 4;

static CODE: Spec = Spec::new("code", "Read device ID code")
    .short("Code")
    .limits(1, 4)
    .note("How much is asked for. Each category has the objects of those before it.")
    .source(SOURCE)
    .names(&[
        Name { value: 1, label: "basic identification", note: "Objects 00h to 02h." },
        Name { value: 2, label: "regular identification", note: "Objects 00h to 7Fh." },
        Name { value: 3, label: "extended identification", note: "Objects 00h to FFh." },
        Name { value: ONE as u64, label: "one object", note: "" },
    ]);

const OBJECT_NAMES: &[Name] = &[
    Name { value: 0, label: "vendor name", note: "" },
    Name { value: 1, label: "product code", note: "" },
    Name { value: 2, label: "revision", note: "" },
    Name { value: 3, label: "vendor URL", note: "" },
    Name { value: 4, label: "product name", note: "" },
    Name { value: 5, label: "model name", note: "" },
    Name { value: 6, label: "user application name", note: "" },
];

const OBJECT_ID: Spec = Spec::new("id", "Object ID")
    .short("ID")
    .format(Format::Hex)
    .note("Which object. 07h to 7Fh are reserved, 80h to FFh are the device's own.")
    .source(SOURCE)
    .names(OBJECT_NAMES);

static FIRST: Spec = Spec {
    key: "object",
    ..OBJECT_ID.note("The first object that is asked for, or the one. 80h to FFh are the device's own.")
};

static ID: Spec = OBJECT_ID;

static CONFORMITY: Spec = Spec::new("conformity", "Conformity level")
    .short("Level")
    .format(Format::Hex)
    .note("What the device can be asked for.")
    .source(SOURCE)
    .names(&[
        Name { value: 0x01, label: "basic, as a stream", note: "" },
        Name { value: 0x02, label: "regular, as a stream", note: "" },
        Name { value: 0x03, label: "extended, as a stream", note: "" },
        Name { value: 0x81, label: "basic, as a stream or one by one", note: "" },
        Name { value: 0x82, label: "regular, as a stream or one by one", note: "" },
        Name { value: 0x83, label: "extended, as a stream or one by one", note: "" },
    ]);

static MORE: Choice = Choice::new(
    Spec::new("more", "More follows")
        .short("More")
        .role(Role::Status)
        .format(Format::Hex)
        .note("Whether the device has more objects, which the client has to ask for.")
        .source(SOURCE),
    1,
    &[Name { value: 0, label: "no", note: "" }, Name { value: 0xFF, label: "yes", note: "" }],
);

static NEXT: Spec = Spec::new("next", "Next object ID")
    .short("Next")
    .format(Format::Hex)
    .note("From where the client has to ask on. 00h where nothing follows.")
    .source(SOURCE);

static COUNT: Spec = Spec::new("objects_count", "Number of objects")
    .short("Objects")
    .role(Role::Count)
    .note("How many objects follow.")
    .source(SOURCE);

static OBJECTS: Spec = Spec::new("objects", "Objects").source(SOURCE);

static OBJECT: Spec = Spec::new("object", "Object").source(SOURCE);

static LENGTH: Spec = Spec::new("length", "Object length")
    .short("Length")
    .role(Role::Count)
    .note("How many bytes the text has.")
    .source(SOURCE);

static TEXT: Spec =
    Spec::new("text", "Text").format(Format::Text).note("What the device says of itself.").source(SOURCE);

const SOURCE: &str = "Modbus application protocol V1.1b3, 6.21";
