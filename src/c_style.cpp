// The C interface to styles: the parameter table and the styles that come with the library. See elastoon.h.
#include "c_interface.h"

#include "check_input.h"

#include <array>
#include <string>

using namespace elastoon;
using namespace elastoon::c_interface;

namespace {

const StyleParameter* parameterNamed(const char* name) {
    for (const StyleParameter& parameter : styleParameters()) {
        if (parameter.name == name) {
            return &parameter;
        }
    }
    return nullptr;
}

ElastoonResult unknownParameter(const char* name) {
    return refuse(kElastoonBadArgument, "there is no style parameter of this name", name);
}

/// The choices of every parameter as one text with commas, made once.
const char* choicesOf(std::size_t index) {
    static const std::vector<std::string> kTexts = [] {
        std::vector<std::string> texts;
        for (const StyleParameter& parameter : styleParameters()) {
            std::string text;
            for (const std::string_view choice : parameter.choices) {
                text += (text.empty() ? "" : ",") + std::string(choice);
            }
            texts.push_back(text);
        }
        return texts;
    }();
    return kTexts[index].c_str();
}

/// The table's texts are literals, and those end with a zero.
const char* textOf(std::string_view literal) {
    return literal.empty() ? "" : literal.data();
}

} // namespace

ElastoonStyle elastoonDefaultStyle(void) {
    return toC(Style{});
}

size_t elastoonStyleParameterCount(void) {
    return styleParameters().size();
}

ElastoonResult elastoonStyleParameter(size_t index, ElastoonStyleParameter* out_parameter) {
    return guarded([&] {
        if (out_parameter == nullptr) {
            return nullPointer("out_parameter");
        }
        if (index >= styleParameters().size()) {
            return refuse(kElastoonBadArgument, "must be less than elastoonStyleParameterCount()", "index");
        }
        const StyleParameter& row = styleParameters()[index];
        *out_parameter = {textOf(row.name),    textOf(row.symbol), textOf(row.unit),
                          textOf(row.meaning), choicesOf(index),   row.minimum,
                          row.maximum,         row.default_value,  row.may_be_derived};
        return kElastoonOk;
    });
}

ElastoonResult elastoonStyleGet(const ElastoonStyle* style, const char* name, double* out_value) {
    if (style == nullptr || name == nullptr || out_value == nullptr) {
        return nullPointer("style, name and out_value");
    }
    const StyleParameter* parameter = parameterNamed(name);
    if (parameter == nullptr) {
        return unknownParameter(name);
    }
    *out_value = parameterValue(from(*style), *parameter);
    return kElastoonOk;
}

ElastoonResult elastoonStyleSet(ElastoonStyle* style, const char* name, double value) {
    return guarded([&] {
        if (style == nullptr || name == nullptr) {
            return nullPointer("style and name");
        }
        const StyleParameter* parameter = parameterNamed(name);
        if (parameter == nullptr) {
            return unknownParameter(name);
        }
        const bool derived = parameter->may_be_derived && value == kDerived;
        if (!derived && !(value >= parameter->minimum && value <= parameter->maximum)) {
            return refuse(kElastoonBadArgument,
                          "must be from " + shortNumber(parameter->minimum) + " to " + shortNumber(parameter->maximum) +
                              ", is " + shortNumber(value),
                          name);
        }
        Style changed = from(*style);
        setParameter(changed, *parameter, value);
        *style = toC(changed);
        return kElastoonOk;
    });
}

size_t elastoonNamedStyleCount(void) {
    return namedStyles().size();
}

ElastoonResult elastoonNamedStyleInfo(size_t index, const char** out_name, const char** out_description) {
    if (index >= namedStyles().size()) {
        return refuse(kElastoonBadArgument, "must be less than elastoonNamedStyleCount()", "index");
    }
    if (out_name != nullptr) {
        *out_name = textOf(namedStyles()[index].name);
    }
    if (out_description != nullptr) {
        *out_description = textOf(namedStyles()[index].description);
    }
    return kElastoonOk;
}

ElastoonResult elastoonNamedStyle(const char* name, ElastoonStyle* out_style) {
    if (name == nullptr || out_style == nullptr) {
        return nullPointer("name and out_style");
    }
    const auto style = styleNamed(name);
    if (!style) {
        return refuse(kElastoonBadArgument, "there is no style of this name; elastoonNamedStyleInfo() lists them",
                      name);
    }
    *out_style = toC(*style);
    return kElastoonOk;
}
