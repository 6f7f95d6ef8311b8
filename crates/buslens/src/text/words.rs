//! Words and signs around bytes: who speaks, what is spoken of, what was thrown away.

use crate::field::Direction;

/// What a line says of who speaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sender {
    /// It calls the telegram a request or a response.
    Says(Direction),
    /// The writer of the log sent it: whether that one asks or answers, the telegrams tell.
    Logger,
    /// The writer of the log received it.
    Other,
}

/// How much a word says. A function's name may have a weak one in it: "read holding registers".
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    Weak,
    Strong,
}

/// What a word is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    Sender(Sender, Weight),
    /// Bytes that stand near it are likely to be a telegram: "frame", "CRC".
    Telegrams,
    /// Bytes that stand near it are what was left over, not a telegram: "discarded".
    Leftovers,
}

use Direction::{Request, Response};
use Sender::{Logger, Other, Says};
use Weight::{Strong, Weak};

/// In the order of their first letters.
static WORDS: &[(&str, About)] = &[
    ("abfrage", said(Says(Request), Strong)),
    ("adu", About::Telegrams),
    ("alınan", said(Other, Strong)),
    ("anfrage", said(Says(Request), Strong)),
    ("answer", said(Says(Response), Strong)),
    ("answered", said(Says(Response), Strong)),
    ("answers", said(Says(Response), Strong)),
    ("antwoord", said(Says(Response), Strong)),
    ("antwort", said(Says(Response), Strong)),
    ("antwortet", said(Says(Response), Strong)),
    ("ask", said(Says(Request), Strong)),
    ("asks", said(Says(Request), Strong)),
    ("bajty", About::Telegrams),
    ("bajtů", About::Telegrams),
    ("befehl", said(Says(Request), Weak)),
    ("begäran", said(Says(Request), Strong)),
    ("buffer", About::Telegrams),
    ("bytes", About::Telegrams),
    ("cerere", said(Says(Request), Strong)),
    ("cevap", said(Says(Response), Strong)),
    ("check", About::Telegrams),
    ("checksum", About::Telegrams),
    ("client", said(Says(Request), Weak)),
    ("cmd", said(Says(Request), Weak)),
    ("command", said(Says(Request), Weak)),
    ("crc", About::Telegrams),
    ("discarded", About::Leftovers),
    ("discarding", About::Leftovers),
    ("dotaz", said(Says(Request), Strong)),
    ("dropped", About::Leftovers),
    ("dropping", About::Leftovers),
    ("empfang", said(Other, Strong)),
    ("empfange", said(Other, Strong)),
    ("empfangen", said(Other, Strong)),
    ("enviada", said(Logger, Strong)),
    ("enviado", said(Logger, Strong)),
    ("enviando", said(Logger, Strong)),
    ("envoi", said(Logger, Strong)),
    ("envoyé", said(Logger, Strong)),
    ("flush", About::Leftovers),
    ("flushed", About::Leftovers),
    ("flushing", About::Leftovers),
    ("frame", About::Telegrams),
    ("frames", About::Telegrams),
    ("garbage", About::Leftovers),
    ("gelen", said(Other, Strong)),
    ("gesendet", said(Logger, Strong)),
    ("gönder", said(Logger, Strong)),
    ("gönderilen", said(Logger, Strong)),
    ("hex", About::Telegrams),
    ("ignored", About::Leftovers),
    ("ignoring", About::Leftovers),
    ("in", said(Other, Weak)),
    ("input", said(Other, Weak)),
    ("inviato", said(Logger, Strong)),
    ("istek", said(Says(Request), Strong)),
    ("junk", About::Leftovers),
    ("kérés", said(Says(Request), Strong)),
    ("leftover", About::Leftovers),
    ("leftovers", About::Leftovers),
    ("lrc", About::Telegrams),
    ("master", said(Says(Request), Weak)),
    ("mensaje", About::Telegrams),
    ("message", About::Telegrams),
    ("messages", About::Telegrams),
    ("modbus", About::Telegrams),
    ("modtaget", said(Other, Strong)),
    ("mottaget", said(Other, Strong)),
    ("mottatt", said(Other, Strong)),
    ("nachricht", About::Telegrams),
    ("octetos", About::Telegrams),
    ("octets", About::Telegrams),
    ("odebrane", said(Other, Strong)),
    ("odebrano", said(Other, Strong)),
    ("odeslano", said(Logger, Strong)),
    ("odesláno", said(Logger, Strong)),
    ("odgovor", said(Says(Response), Strong)),
    ("odpoved", said(Says(Response), Strong)),
    ("odpověď", said(Says(Response), Strong)),
    ("odpowiedz", said(Says(Response), Strong)),
    ("odpowiedź", said(Says(Response), Strong)),
    ("ontvangen", said(Other, Strong)),
    ("out", said(Logger, Weak)),
    ("output", said(Logger, Weak)),
    ("packet", About::Telegrams),
    ("packets", About::Telegrams),
    ("paket", About::Telegrams),
    ("paquete", About::Telegrams),
    ("payload", About::Telegrams),
    ("pdu", About::Telegrams),
    ("požadavek", said(Says(Request), Strong)),
    ("prijato", said(Other, Strong)),
    ("prüfsumme", About::Telegrams),
    ("přijato", said(Other, Strong)),
    ("query", said(Says(Request), Strong)),
    ("rahmen", About::Telegrams),
    ("ramka", About::Telegrams),
    ("ramki", About::Telegrams),
    ("raspuns", said(Says(Response), Strong)),
    ("raw", About::Telegrams),
    ("rcv", said(Other, Strong)),
    ("rcvd", said(Other, Strong)),
    ("read", said(Other, Weak)),
    ("reading", said(Other, Weak)),
    ("recd", said(Other, Strong)),
    ("recebida", said(Other, Strong)),
    ("recebido", said(Other, Strong)),
    ("receive", said(Other, Strong)),
    ("received", said(Other, Strong)),
    ("receiving", said(Other, Strong)),
    ("reception", said(Other, Strong)),
    ("recibida", said(Other, Strong)),
    ("recibido", said(Other, Strong)),
    ("recibiendo", said(Other, Strong)),
    ("recv", said(Other, Strong)),
    ("replies", said(Says(Response), Strong)),
    ("reply", said(Says(Response), Strong)),
    ("reponse", said(Says(Response), Strong)),
    ("req", said(Says(Request), Strong)),
    ("request", said(Says(Request), Strong)),
    ("requests", said(Says(Request), Strong)),
    ("requete", said(Says(Request), Strong)),
    ("requête", said(Says(Request), Strong)),
    ("resp", said(Says(Response), Strong)),
    ("respond", said(Says(Response), Strong)),
    ("responds", said(Says(Response), Strong)),
    ("response", said(Says(Response), Strong)),
    ("resposta", said(Says(Response), Strong)),
    ("respuesta", said(Says(Response), Strong)),
    ("reçu", said(Other, Strong)),
    ("ricevuto", said(Other, Strong)),
    ("richiesta", said(Says(Request), Strong)),
    ("risposta", said(Says(Response), Strong)),
    ("rsp", said(Says(Response), Strong)),
    ("rx", said(Other, Strong)),
    ("rxd", said(Other, Strong)),
    ("réception", said(Other, Strong)),
    ("réponse", said(Says(Response), Strong)),
    ("răspuns", said(Says(Response), Strong)),
    ("send", said(Logger, Strong)),
    ("sende", said(Logger, Strong)),
    ("sending", said(Logger, Strong)),
    ("sends", said(Logger, Strong)),
    ("sent", said(Logger, Strong)),
    ("server", said(Says(Response), Weak)),
    ("skickat", said(Logger, Strong)),
    ("skipped", About::Leftovers),
    ("skipping", About::Leftovers),
    ("slave", said(Says(Response), Weak)),
    ("snd", said(Logger, Strong)),
    ("solicitud", said(Says(Request), Strong)),
    ("sorgu", said(Says(Request), Strong)),
    ("stale", About::Leftovers),
    ("svar", said(Says(Response), Strong)),
    ("sänt", said(Logger, Strong)),
    ("telegram", About::Telegrams),
    ("telegramm", About::Telegrams),
    ("telegramme", About::Telegrams),
    ("telegrams", About::Telegrams),
    ("thrown", About::Leftovers),
    ("trama", About::Telegrams),
    ("trame", About::Telegrams),
    ("transmis", said(Logger, Strong)),
    ("transmit", said(Logger, Strong)),
    ("transmitted", said(Logger, Strong)),
    ("trasmesso", said(Logger, Strong)),
    ("tx", said(Logger, Strong)),
    ("txd", said(Logger, Strong)),
    ("unexpected", About::Leftovers),
    ("vastaus", said(Says(Response), Strong)),
    ("verschickt", said(Logger, Strong)),
    ("verzoek", said(Says(Request), Strong)),
    ("verzonden", said(Logger, Strong)),
    ("válasz", said(Says(Response), Strong)),
    ("write", said(Logger, Weak)),
    ("writing", said(Logger, Weak)),
    ("written", said(Logger, Strong)),
    ("wrote", said(Logger, Weak)),
    ("wysyłanie", said(Logger, Strong)),
    ("wysłane", said(Logger, Strong)),
    ("wysłano", said(Logger, Strong)),
    ("yanıt", said(Says(Response), Strong)),
    ("zahtev", said(Says(Request), Strong)),
    ("zapytanie", said(Says(Request), Strong)),
];

/// Words and signs of scripts that have no capital letters: each ends where the next one begins.
static SIGNS: &[(&str, About)] = &[
    ("→", said(Logger, Strong)),
    ("←", said(Other, Strong)),
    ("⇒", said(Logger, Strong)),
    ("⇐", said(Other, Strong)),
    ("发送", said(Logger, Strong)),
    ("發送", said(Logger, Strong)),
    ("接收", said(Other, Strong)),
    ("请求", said(Says(Request), Strong)),
    ("响应", said(Says(Response), Strong)),
    ("发", said(Logger, Strong)),
    ("發", said(Logger, Strong)),
    ("收", said(Other, Strong)),
    ("送信", said(Logger, Strong)),
    ("受信", said(Other, Strong)),
    ("要求", said(Says(Request), Strong)),
    ("応答", said(Says(Response), Strong)),
    ("查询", said(Says(Request), Strong)),
    ("指令", said(Says(Request), Weak)),
    ("命令", said(Says(Request), Weak)),
    ("返回", said(Says(Response), Strong)),
    ("回复", said(Says(Response), Strong)),
    ("应答", said(Says(Response), Strong)),
    ("回應", said(Says(Response), Strong)),
    ("요청", said(Says(Request), Strong)),
    ("응답", said(Says(Response), Strong)),
    ("송신", said(Logger, Strong)),
    ("수신", said(Other, Strong)),
    // Without their first letters, which may be capital ones: запрос, ответ, отправлено, принято, получено.
    ("апрос", said(Says(Request), Strong)),
    ("твет", said(Says(Response), Strong)),
    ("тправ", said(Logger, Strong)),
    ("ринят", said(Other, Strong)),
    ("олучен", said(Other, Strong)),
];

const fn said(sender: Sender, weight: Weight) -> About {
    About::Sender(sender, weight)
}

/// A word's letters as one number: small ones, and of others nothing that a letter could be.
const fn packed(word: &[u8]) -> u128 {
    let (mut packed, mut at) = (0, 0);
    while at < word.len() {
        packed = (packed << 8) + (word[at] | 0x20) as u128;
        at += 1;
    }
    packed
}

/// The [`WORDS`] as numbers.
static PACKED: [u128; WORDS.len()] = {
    let mut all = [0; WORDS.len()];
    let mut at = 0;
    while at < WORDS.len() {
        all[at] = packed(WORDS[at].0.as_bytes());
        at += 1;
    }
    all
};

/// Where in [`WORDS`] the words of each first letter begin; the last one is where all end.
static FIRST: [u8; 27] = {
    let mut first = [0; 27];
    let (mut letter, mut at) = (0, 0);
    while letter < 27 {
        while at < WORDS.len() && WORDS[at].0.as_bytes()[0] < b'a' + letter as u8 {
            at += 1;
        }
        first[letter] = at as u8;
        letter += 1;
    }
    first
};

/// What `word` is about, in whatever letters it is written.
pub fn word(word: &[u8]) -> Option<About> {
    const LONGEST: usize = 11;
    if !(2..=LONGEST).contains(&word.len()) {
        return None;
    }
    let letter = word[0].to_ascii_lowercase().checked_sub(b'a')?;
    let [from, to] = *FIRST.get(usize::from(letter)..)?.first_chunk()?;
    let packed = packed(word);
    (usize::from(from)..usize::from(to)).find(|at| PACKED[*at] == packed).map(|at| WORDS[at].1)
}

/// Who speaks, as a part of a name in a program says: `requestText`, `rxBuffer`, `ReadCoilsResponse`.
pub fn part(name: &[u8]) -> Option<Sender> {
    let begins = |at: &usize| name[at - 1].is_ascii_lowercase() && name[*at].is_ascii_uppercase();
    let mut from = 0;
    (1..name.len()).filter(begins).chain([name.len()]).find_map(|to| {
        let part = &name[std::mem::replace(&mut from, to)..to];
        match word(part)? {
            About::Sender(sender, Strong) => Some(sender),
            _ => None,
        }
    })
}

/// What the sign that begins at `at` is about, and where it ends.
pub fn sign(line: &[u8], at: usize) -> Option<(About, usize)> {
    let found = SIGNS.iter().find(|(sign, _)| line[at..].starts_with(sign.as_bytes()));
    found.map(|(sign, about)| (*about, at + sign.len()))
}

/// What the arrow that begins at `at` says, and where it ends: `->`, `<-`, `>>>`, `<<`, `=>`.
pub fn arrow(line: &[u8], at: usize) -> Option<(Sender, usize)> {
    let rest = &line[at..];
    let run = |c: u8| rest.iter().take_while(|other| **other == c).count();
    match rest {
        [b'-' | b'=', b'>', ..] => Some((Logger, at + 2)),
        [b'<', b'-' | b'=', ..] => Some((Other, at + 1 + 1)),
        [b'>', b'>', ..] => Some((Logger, at + run(b'>'))),
        [b'<', b'<', ..] => Some((Other, at + run(b'<'))),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_in_any_letters() {
        assert_eq!(word(b"TX"), Some(said(Logger, Strong)));
        assert_eq!(word(b"Response"), Some(said(Says(Response), Strong)));
        assert_eq!(word(b"reads"), None);
        assert_eq!(word("é".as_bytes()), None);
        for (known, about) in WORDS {
            assert_eq!(word(known.as_bytes()), Some(*about), "{known}");
        }
    }

    #[test]
    fn parts_of_names() {
        assert_eq!(part(b"requestText"), Some(Says(Request)));
        assert_eq!(part(b"ReadCoilsResponse"), Some(Says(Response)));
        assert_eq!(part(b"bytesSent"), Some(Logger));
        assert_eq!(part(b"rxBuffer"), Some(Other));
        assert_eq!(part(b"Requested"), None);
        assert_eq!(part(b"messageId"), None);
        assert_eq!(part(b"A"), None);
    }

    #[test]
    fn signs_of_other_scripts() {
        assert_eq!(sign("→ 01".as_bytes(), 0), Some((said(Logger, Strong), 3)));
        assert_eq!(sign("发送 01".as_bytes(), 0), Some((said(Logger, Strong), 6)));
        assert_eq!(sign("你".as_bytes(), 0), None);
    }

    #[test]
    fn arrows() {
        assert_eq!(arrow(b">>> 01", 0), Some((Logger, 3)));
        assert_eq!(arrow(b"x <- 01", 2), Some((Other, 4)));
        assert_eq!(arrow(b"> 01", 0), None);
        assert_eq!(arrow(b"<01><03>", 0), None);
    }
}
