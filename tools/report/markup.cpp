#include "report/markup.h"

#include "cli/json.h"

namespace talus::tools {

std::string escapedMarkup(std::string_view text) {
    std::string safe;
    for (const char letter : validUtf8(std::string(text))) {
        switch (letter) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            case '\'':
                safe += "&#39;";
                break;
            case '\t':
            case '\n':
            case '\r':
                safe += letter;
                break;
            default:
                const bool is_control = static_cast<unsigned char>(letter) < 0x20;
                const bool ends_noncharacter =
                    safe.ends_with("\xEF\xBF") && (letter == '\xBE' || letter == '\xBF');
                safe += is_control          ? "\xEF\xBF\xBD"
                        : ends_noncharacter ? std::string(1, '\xBD')
                                            : std::string(1, letter);
        }
    }
    return safe;
}

}  // namespace talus::tools
