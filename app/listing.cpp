#include "app/listing.h"

#include "app/command_table.h"
#include "app/preset_library.h"
#include "engine/core/version.h"
#include "engine/preset/field_table.h"
#include "engine/preset/writer.h"
#include "engine/record/json.h"

namespace gridshell::app {
namespace {

using record::Json;

Json commands_json() {
  Json all = Json::array();
  for (const CommandEntry& command : command_table()) {
    Json one = Json::object();
    one["name"] = command.name;
    one["meaning"] = command.meaning;
    one["options"] = Json::array();
    for (const CommandOption& option : command.options) {
      Json json = Json::object();
      json["name"] = option.name;
      if (!option.short_name.empty()) json["short"] = option.short_name;
      json["meaning"] = option.meaning;
      if (!option.words.empty()) json["words"] = option.words;
      json["argument"] = option.argument;
      json["flag"] = option.flag;
      json["required"] = option.required;
      json["many"] = option.many;
      one["options"].push_back(std::move(json));
    }
    all.push_back(std::move(one));
  }
  return all;
}

Json keys_json() {
  Json all = Json::array();
  for (const preset::KeyText& key : preset::key_texts()) {
    Json one = Json::object();
    one["table"] = key.table;
    one["key"] = key.key;
    one["unit"] = key.unit;
    one["default"] = key.value;
    one["allowed"] = key.allowed;
    one["meaning"] = key.meaning;
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

Result<std::string> listing_json() {
  Json json = Json::object();
  json["version"] = version();
  json["commands"] = commands_json();
  json["presets"] = Json::array();
  for (const EmbeddedPreset& embedded : embedded_presets()) {
    const auto presets = load_preset(embedded.name, {});
    if (!presets) return tl::unexpected(presets.error());
    Json one = Json::object();
    one["name"] = embedded.name;
    one["title"] = presets->base.title;
    one["description"] = presets->base.description;
    one["source"] = presets->base.source;
    json["presets"].push_back(std::move(one));
  }
  json["tables"] = Json::array();
  for (const preset::Table& table : preset::tables()) {
    Json one = Json::object();
    one["name"] = table.name;
    one["meaning"] = table.meaning;
    one["list"] = table.list;
    json["tables"].push_back(std::move(one));
  }
  json["keys"] = keys_json();
  return record::text_of(json);
}

}  // namespace gridshell::app
